#!/usr/bin/env python3
"""Every link within the site leads to a file and a place in it, and so does what its style sheets import.

    check_links.py SITE     prints one line for each that does not; exit 1 if there is any

Of the C++ reference, whose own links are Doxygen's, those are looked at that leave it.
"""

import html.parser
import pathlib
import re
import sys
import urllib.parse

SHEET = re.compile(r"""url\(\s*["']?([^"')]+?)["']?\s*\)|@import\s+["']([^"']+)["']""")


class Page(html.parser.HTMLParser):
    """The anchors and links of a page, and what it would fetch from elsewhere."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.fetched = {""}, [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.anchors |= {values[key] for key in ("id", "name") if values.get(key)}
        target = values.get("href" if tag in ("a", "link") else "src")
        if target:
            self.links.append(target)
            if tag != "a" and urllib.parse.urlsplit(target).scheme in ("http", "https"):
                self.fetched.append(target)


def sheet_faults(site):
    """What the site's own style sheets, and those within its pages, would fetch and cannot from a folder on a disk."""
    sheets = {path: path.read_text(encoding="utf-8") for path in site.rglob("*.css")}
    for path in site.rglob("*.html"):
        sheets[path] = "\n".join(re.findall(r"(?s)<style.*?</style>", path.read_text(encoding="utf-8")))
    for path, text in sorted(sheets.items()):
        for target in (quoted or plain for quoted, plain in SHEET.findall(re.sub(r"(?s)/\*.*?\*/", "", text))):
            parts = urllib.parse.urlsplit(target)
            if parts.scheme == "data" or target.startswith("#"):
                continue
            if parts.scheme or parts.netloc or parts.path.startswith("/"):
                yield f"{path.relative_to(site)}: fetches {target}"
            elif not (path.parent / urllib.parse.unquote(parts.path)).is_file():
                yield f"{path.relative_to(site)}: no such file: {target}"


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in site.rglob("*.html") if "_static" not in path.parts}
    faults, count = list(sheet_faults(site)), 0
    for path, page in sorted(pages.items()):
        reference = path.is_relative_to(site / "cpp")
        faults += [f"{path.relative_to(site)}: fetches {target}" for target in page.fetched]
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if reference and target.is_relative_to(site / "cpp"):
                continue
            count += 1
            if not target.is_file():
                faults.append(f"{path.relative_to(site)}: no such file: {link}")
            elif target in pages and not target.is_relative_to(site / "cpp") and \
                    urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                faults.append(f"{path.relative_to(site)}: no such place: {link}")
    print("\n".join(faults), end="\n" if faults else "")
    own = sum(1 for path in pages if not path.is_relative_to(site / "cpp"))
    print(f"{own} pages and {len(pages) - own} of the C++ reference, {count} links; leading nowhere: {len(faults)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
