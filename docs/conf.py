"""The site, by Sphinx with MyST: every page of the repository, as it stands there. docs/build calls it."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs" / "site"))

project = "thinwall"
author = "the authors of thinwall"
copyright = "the authors of thinwall, AGPL-3.0-or-later"  # pylint: disable=redefined-builtin
extensions = ["myst_parser", "sphinx_copybutton", "equations"]

# The source folder is the repository itself, so that links between pages are those of the files.
root_doc = "docs/index"
include_patterns = ["*.md", "docs/**", "cases/*/README.md"]
exclude_patterns = ["build", "results", ".git", ".ci", "tests", "fuzz", "bench", "python", "web", "examples"]

myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 4
highlight_language = "none"
html_theme = "furo"
html_title = "thinwall"
html_static_path = ["site/static", "../build/site-work/static"]  # with the font that docs/build puts there
html_css_files = ["thinwall.css"]
html_copy_source = False
html_show_sphinx = False
html_last_updated_fmt = None
html_baseurl = ""
copybutton_exclude = ".linenos, .gp, .eqno"
