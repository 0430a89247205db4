"""What the site needs beside MkDocs: navigation from groups of documents, pages for files of the tree that documents link to, and
a check of every link and anchor; what is broken is a warning, which ends a strict build."""

import collections
import fnmatch
import html.parser
import logging
import os
import re
import shutil
import tempfile
import urllib.parse

from mkdocs.structure.files import File

log = logging.getLogger("mkdocs.site")
LINK = re.compile(r"\]\(((?:\.\./)+)([^)#\s]+)(#[^)]*)?\)")
sources = {}  # path in the tree: page of the site that shows it
titles = collections.Counter()  # anchors of the page at hand
generated = tempfile.TemporaryDirectory()


def on_config(config):
    config["mdx_configs"]["toc"]["slugify"] = slug
    return config


def on_page_markdown(markdown, page, config, files):
    titles.clear()
    return with_pages_of_sources(markdown, page, config)


def slug(title, separator):
    """The anchor of a title as GitHub makes it, so that links hold in both places; a title that comes again is counted, -1, -2."""
    anchor = re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", separator)
    titles[anchor] += 1
    return anchor if titles[anchor] == 1 else f"{anchor}{separator}{titles[anchor] - 1}"


def on_files(files, config):
    for file in [f for f in files if f.src_path.startswith("site/") and not f.src_path.endswith(".css")]:
        files.remove(file)
    add_sources(files, config)
    config["nav"] = navigation(files, config)
    return files


def outside(page, link, config):
    """Path in the tree of a file beside the documents that a page links to, or nothing."""
    docs = config["docs_dir"]
    path = os.path.normpath(os.path.join(docs, os.path.dirname(page), link))
    tree = os.path.dirname(docs)
    if path.startswith(docs + os.sep) or not path.startswith(tree + os.sep) or not os.path.isfile(path):
        return None
    return os.path.relpath(path, tree)


def add_sources(files, config):
    for page in list(files.documentation_pages()):
        with open(page.abs_src_path, encoding="utf-8") as text:
            for up, link, _ in LINK.findall(text.read()):
                if path := outside(page.src_path, up + link, config):
                    sources[path] = "tree/" + path
    for path in sorted(sources):
        with open(os.path.join(os.path.dirname(config["docs_dir"]), path), "rb") as content:
            add_source(path, content.read(), files, config)


def add_source(path, content, files, config):
    """A page that shows a text; a picture or the like stays a file."""
    try:
        content = (f"# {path}\n\n" + "".join("    " + line for line in content.decode().splitlines(True))).encode()
        sources[path] += ".md"
    except UnicodeDecodeError:
        pass
    target = os.path.join(generated.name, sources[path])
    os.makedirs(os.path.dirname(target), exist_ok=True)
    with open(target, "wb") as out:
        out.write(content)
    files.append(File(sources[path], generated.name, config["site_dir"], False))


def navigation(files, config):
    left = [f.src_path for f in files.documentation_pages() if not f.src_path.startswith("tree/")]
    nav = []
    for title, patterns in config["extra"]["groups"] + [["More", ["*"]]]:
        chosen = []
        for pattern in patterns:
            found = sorted(path for path in left if fnmatch.fnmatch(path, pattern))
            chosen += found
            left = [path for path in left if path not in found]
        if chosen:
            nav.append({title: chosen})
    return nav


def with_pages_of_sources(markdown, page, config):
    def shown(match):
        path = outside(page.file.src_path, match[1] + match[2], config)
        if path is None:
            return match[0]
        return "](" + os.path.relpath(sources[path], os.path.dirname(page.file.src_path) or ".") + ")"

    return LINK.sub(shown, markdown)


def on_post_page(output, page, config):
    """The start by its file, since a browser without a server shows no folder."""
    return re.sub(r'href="((?:\.\./)*\.\.?)"', r'href="\1/index.html"', output)


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links = set(), []
        with open(path, encoding="utf-8") as text:
            self.feed(text.read())

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.ids |= {attrs[key] for key in ("id", "name") if attrs.get(key)}
        for key in ("href", "src"):
            if attrs.get(key):
                self.links.append((tag, attrs[key]))


def complete_theme(site):
    """Debian's package of the theme names two scripts that it does not hold: jQuery, under another version, and one of
    tables, which site.css does."""
    scripts = os.path.join(site, "js")
    jquery, extra = (os.path.join(scripts, name) for name in ("jquery-3.6.0.min.js", "theme_extra.js"))
    older = sorted(name for name in os.listdir(scripts) if name.startswith("jquery-"))
    if not os.path.exists(jquery) and older:
        shutil.copyfile(os.path.join(scripts, older[-1]), jquery)
    if not os.path.exists(extra):
        open(extra, "w", encoding="utf-8").close()


def on_post_build(config):
    site = config["site_dir"]
    complete_theme(site)
    pages = {}
    for folder, _, names in os.walk(site):
        for name in names:
            if name.endswith(".html") and name != "404.html":
                path = os.path.join(folder, name)
                pages[path] = Page(path)
    for path, page in pages.items():
        for tag, link in page.links:
            if reason := broken(path, tag, link, pages):
                log.warning("%s: %s: %s", os.path.relpath(path, site), link, reason)


def broken(path, tag, link, pages):
    parts = urllib.parse.urlparse(link)
    if parts.scheme or parts.netloc:
        return "needs a network to be seen" if tag in ("script", "img", "link") and parts.scheme != "data" else None
    target = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(parts.path))) if parts.path else path
    if not os.path.exists(target):
        return "there is no such file"
    if os.path.isdir(target):
        return "is a folder, which browsers do not list"
    anchor = urllib.parse.unquote(parts.fragment)
    if anchor and target in pages and anchor not in pages[target].ids:
        return "there is no such anchor"
    return None
