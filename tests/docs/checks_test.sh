#!/bin/bash
# The checks of the documentation object to each kind of fault and to nothing else; docs/build calls them on the pages and
# the library's headers. Comments are read by Doxygen: without it that part is skipped, and so is the test (77).
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=../install/expect.sh source-path=SCRIPTDIR
source "$here/../install/expect.sh"
root=$(readlink -f "$here/../..")
python=${1:-python3}
export PYTHONDONTWRITEBYTECODE=1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

# --- equations
mkdir -p "$tree"/{docs/theory,coupling}
printf '# A chapter\n\n    a = b      (1)\n    c = d      (2)\n\nSee (1).\n' >"$tree/docs/theory/chapter.md"
cited() {  # line of a header
  printf '%b\n' "$1" >"$tree/coupling/a.hpp"
  "$python" "$here/equations_test.py" "$tree" || true
}
expect_contains "an equation that is there" "faults: 0" "$(cited '/// docs/theory/chapter.md, Eq. 1-2')"
expect_contains "one that is not" "coupling/a.hpp:1: docs/theory/chapter.md has no equation (3)" \
  "$(cited '/// docs/theory/chapter.md, Eq. 2-3')"
expect_contains "over the end of a line" "has no equation (4)" "$(cited '/// (docs/theory/chapter.md, Eq.\n/// 4)')"
expect_contains "a chapter that is not there" "no docs/theory/other.md" "$(cited '/// docs/theory/other.md')"
expect_contains "another author's" "faults: 0" "$(cited '/// Johnson 1985, Eq. 7.44')"
printf '\n    e = f      (2)\n' >>"$tree/docs/theory/chapter.md"
expect_contains "a number twice" "two equations (2)" "$(cited '')"

# --- pictures: light enough for a repository, and shown
for picture in "$root"/docs/pictures/*.png; do
  name=$(basename "$picture")
  expect_equal "$name is a PNG" "89504e470d0a1a0a" "$(head -c 8 "$picture" | od -An -tx1 | tr -d ' ')"
  expect_equal "$name has at most 150 kB" yes "$([[ $(stat -c %s "$picture") -le 150000 ]] && echo yes || echo no)"
  expect_contains "the first tutorial shows $name" "pictures/$name)" "$(<"$root/docs/tutorials/ten-minutes.md")"
done
expect_contains "the README shows the chart within its first 25 lines" "pictures/lobes.png)" "$(head -n 25 "$root/README.md")"
expect_equal "the README has at most 120 lines" yes "$([[ $(wc -l <"$root/README.md") -le 120 ]] && echo yes || echo no)"

# --- links
mkdir -p "$tree/site/cpp"
links() { "$python" "$root/docs/site/check_links.py" "$tree/site" || true; }
printf '<h1 id="top">A</h1><a href="b.html#there">b</a><a href="https://debian.org">c</a>' >"$tree/site/a.html"
printf '<p id="there"><a href="a.html#top">a</a>' >"$tree/site/b.html"
expect_contains "links that lead somewhere" "2 links; leading nowhere: 0" "$(links)"
printf '<a href="b.html#not">b</a><a href="c.html">c</a><img src="https://debian.org/x.png">' >"$tree/site/a.html"
expect_contains "a place that is not there" "a.html: no such place: b.html#not" "$(links)"
expect_contains "a page that is not there" "a.html: no such file: c.html" "$(links)"
expect_contains "something from elsewhere" "a.html: fetches https://debian.org/x.png" "$(links)"
printf '%s' '@import url(/root.css); @import "c.css"; a { b: url("b.html") url(data:x) } /* url(d.css) */' >"$tree/site/a.css"
printf '<p id="there"><style>c { d: url(https://debian.org/y.png) }</style>' >"$tree/site/b.html"
expect_contains "a style sheet's import from a server's root" "a.css: fetches /root.css" "$(links)"
expect_contains "one that is not there" "a.css: no such file: c.css" "$(links)"
expect_contains "one within a page" "b.html: fetches https://debian.org/y.png" "$(links)"
expect_equal "no others" 3 "$(links | grep -c -e css: -e ^b.html)"
printf '<a href="../b.html#not">b</a>' >"$tree/site/cpp/c.html"
expect_contains "from the C++ reference" "cpp/c.html: no such place" "$(links)"

# --- first words of comments
mkdir -p "$tree/sources/core"
beginnings() {  # lines of a header
  printf '%b\n' "$1" >"$tree/sources/core/a.hpp"
  "$python" "$root/docs/site/check_comments.py" "$tree/sources" || true
}
expect_contains "a comment without a subject" "core/a.hpp:2: What it is.
2 comments; without a subject: 1, at most 20" "$(beginnings '#pragma once\n// What it is.\n/// The number.\n/// Where it goes on.')"
expect_contains "words within a comment" "without a subject: 0" "$(beginnings '/// Whatever.\n/// What.\nint a;  // What')"
status() { "$python" "$root/docs/site/check_comments.py" "$tree/sources" >/dev/null && echo 0 || echo 1; }
for ((i = 0; i < 20; ++i)); do printf '/// How %d.\nint a%d;\n' $i $i; done >"$tree/sources/core/a.hpp"
expect_equal "as many as are allowed" 0 "$(status)"
echo '/// Of the last.' >>"$tree/sources/core/a.hpp"
expect_equal "one too many" 1 "$(status)"

# --- comments
command -v doxygen >/dev/null || {
  finish
  echo "no doxygen: comments not checked"
  exit 77
}
comments() {  # folder of headers
  rm -rf "$tree/xml"
  {
    cat "$root/docs/Doxyfile"
    printf '%s\n' "INPUT = $1" "STRIP_FROM_PATH = $1" "OUTPUT_DIRECTORY = $tree" GENERATE_HTML=NO USE_MDFILE_AS_MAINPAGE=
  } | doxygen -q -
  "$python" "$root/docs/site/check_headers.py" "$tree/xml" || true
}
mkdir "$tree/headers"
cat >"$tree/headers/a.hpp" <<'HPP'
/// All.
namespace thinwall {
/// Said.
struct Said {
  Said();
  int number = 0;
  /// Said.
  int said() const;
  int unsaid() const;
  bool operator==(const Said&) const = default;
 private:
  int own() const;
};
struct Unsaid {};
/// Said.
int said(int a);
int unsaid(int a);
int trailing();  ///< said
enum class Kind { a };
}
HPP
expect_equal "what has no comment" "a.hpp:14: struct thinwall::Unsaid
a.hpp:17: function unsaid(int a)
a.hpp:19: enum Kind
a.hpp:9: function unsaid() const
5 public functions and 3 types; without a comment: 4" "$(comments "$tree/headers")"
finish
