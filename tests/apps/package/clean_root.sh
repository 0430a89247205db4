#!/usr/bin/env bash
# clean_root.sh PACKAGE.deb [ROOT.tar]: installs the package in a clean root of Debian 12, as apt does, uses it as a plain user,
# removes and purges it.  As root; downloads some 260 MB of what the package depends on from the system's own sources.
# ROOT.tar is kept for the next time.
set -euo pipefail

# In a space of mounts of its own, which ends with it.
[[ ${GESTELL_ROOT_MOUNTS:-} == own ]] || GESTELL_ROOT_MOUNTS=own exec unshare --mount --propagation private "$0" "$@"

package=$(realpath "$1")
sources=(/etc/apt/sources.list.d/debian.sources)
[[ -s /etc/apt/sources.list ]] && sources=(/etc/apt/sources.list)
work=$(mktemp -d)
tar=${2:-$work/root.tar}
root=$work/root
unmount() { for place in proc dev; do mountpoint -q "$root/$place" && umount --lazy "$root/$place"; done; true; }
trap 'unmount; rm -rf --one-file-system "$work"' EXIT

[[ -e $tar ]] || mmdebstrap --quiet --variant=minbase bookworm "$tar" "${sources[@]}"
mkdir "$root"
tar -xf "$tar" -C "$root" --exclude=./dev
mkdir -p "$root/dev"
mount --rbind /dev "$root/dev"
mount -t proc proc "$root/proc"
for file in /etc/resolv.conf /etc/hosts; do cat "$file" >"$root$file"; done
cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
cp "$package" "$root/"
name=$(basename "$package")
in_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
files() { (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./var/cache -o -path ./var/lib -o -path ./var/log -o -path "./*.deb" \) -prune -o -print | sort); }

in_root apt-get -q update >/dev/null
in_root apt-get -qq -y --download-only install "/$name" >/dev/null
in_root useradd -m anna
echo "depends on $(in_root apt-get -s install "/$name" | grep -c '^Inst') packages of a minimal system"

begin=$(date +%s)
in_root apt-get -qq -y install "/$name" >"$work/apt.log" 2>&1 || { cat "$work/apt.log"; exit 1; }
installed=$(date +%s)
as_user() { in_root su - anna -c "$1"; }
as_user 'gestell new press >/dev/null && gestell run press.toml --quiet >/dev/null 2>&1 && test -s results/press/report.html'
report=$(date +%s)
echo "installed in $((installed - begin)) s, first report $((report - installed)) s later"
[[ $((report - installed)) -le 60 ]] || { echo "the first report took more than 60 s" >&2; exit 1; }

as_user 'python3 -c "import gestell; print(gestell.example(\"press_minimal\").run(peaks=\"F_P\"))"'
as_user 'bash -c "source /usr/share/bash-completion/completions/gestell; complete -p gestell"'
in_root test -s /usr/share/man/man1/gestell.1.gz
for core in Prescott Haswell; do # as tests/processors: BLAS and kernels of others, as far as this one can take them
  [[ $core == Haswell ]] && ! grep -qw avx2 /proc/cpuinfo && continue
  kernels=
  [[ $core == Prescott ]] && kernels=portable
  as_user "OPENBLAS_CORETYPE=$core GESTELL_KERNELS=$kernels GESTELL_CACHE=\$(mktemp -d) gestell run press.toml --quiet -o r-$core >/dev/null 2>&1"
  echo "runs as $core"
done

in_root apt-get -qq -y install --no-install-recommends g++ cmake make pkg-config >/dev/null 2>&1
as_user 'mkdir -p example && cd example && sed -n "/^\`\`\`cmake/,/^\`\`\`/p" /usr/share/doc/gestell/docs/reference/library.md | grep -v "^\`\`\`" >CMakeLists.txt &&
  sed -n "/^\/\/ duffing.cc/,/^\`\`\`/p" /usr/share/doc/gestell/docs/reference/library.md | grep -v "^\`\`\`" >duffing.cc &&
  sed -n "/^\/\/ stiffer_rod.cc/,/^\`\`\`/p" /usr/share/doc/gestell/docs/reference/library.md | grep -v "^\`\`\`" >stiffer_rod.cc &&
  cmake -S . -B out >/dev/null && cmake --build out >/dev/null && out/duffing && out/stiffer_rod /usr/share/gestell/scenes/press_minimal.toml | tail -1 &&
  g++ duffing.cc $(pkg-config --cflags --libs gestell) -o plain && ./plain'

in_root apt-get -qq -y purge gestell >/dev/null 2>&1
left=$(files | grep -i gestell | grep -v '^./home/anna' || true)
[[ -z $left ]] || { printf 'purge leaves:\n%s\n' "$left" >&2; exit 1; }
echo "removed and purged: nothing is left"
