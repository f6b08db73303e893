"""Equations as plain text, in the characters of the headers, set and numbered on the site.

An indented block of a chapter in docs/theory is an equation; a line that ends in "(4)" has that number. The site sets
sub- and superscripts, keeps the columns, gives each number an anchor (#eq-4) and links what mentions it: "(4)" in the
chapter itself, "`coupling.md` (4)" and "coupling.md, Eq. 4" from anywhere. Other files named in backticks become links too.
"""

import html
import pathlib
import posixpath
import re

NUMBER = r"[A-Z]?\d+[a-z]?"
NUMBERED_LINE = re.compile(rf"^(.*\S)\s+\(({NUMBER})\)\s*$")
INDENTED = re.compile(r"^ {4}\s*\S")
COLUMN = re.compile(r" *\S(?:.*?\S)??(?: {3,}|$)")
MENTION = re.compile(rf"\(({NUMBER})\)|Eq\. ({NUMBER})")
FOREIGN = re.compile(r"(\d{4},? ?\(?|\w)$")  # what stands before a number of another author's: "Bondarenko 2012 (26)"
FILE = re.compile(r"(?:[\w-]+/)*[\w-]+\.md$")

LETTER = r"[0-9A-Za-z\u0370-\u03ffℓ]"  # not ᵀ, ₀ and their like, which are scripts themselves
SCRIPT = re.compile(rf"([_^])(\{{[^{{}}]*(?:\{{[^{{}}]*\}}[^{{}}]*)*\}}|{LETTER}+'*|[∞⅓½⅔*−+]+{LETTER}*½?)")
INLINE_SCRIPT = re.compile(
    rf"(?<![\w/.])(?:e|[^\W\d_]{{1,4}}[⁰-⁹₀-₉̄'*]*|‖|\||\)(?=\^))"  # a symbol, not a word ...
    rf"((?:[_^](?:\{{[^{{}}]*\}}|{LETTER}+'*|[∞⅓½⅔−+]+{LETTER}*))+)(?!_)")  # ... and its scripts


def numbers(text):
    """The numbers of a chapter's equations, in order."""
    found = []
    for line in text.splitlines():
        match = INDENTED.match(line) and NUMBERED_LINE.match(line)
        if match:
            found.append(match.group(2))
    return found


def with_scripts(text):
    """HTML of text with X_ab and e^{iωt} set as sub- and superscripts."""
    out, end = [], 0
    for match in SCRIPT.finditer(text):
        tag = "sub" if match.group(1) == "_" else "sup"
        inner = with_scripts(match.group(2).removeprefix("{").removesuffix("}"))
        out += [html.escape(text[end:match.start()]), f"<{tag}>{inner}</{tag}>"]
        end = match.end()
    return "".join(out) + html.escape(text[end:])


def display(block):
    """HTML of an indented block: what stands three blanks apart is a column, as wide as it was written."""
    lines = block.splitlines()
    out = []
    for line in lines:
        match = NUMBERED_LINE.match(line)
        body, number = match.groups() if match else (line, None)
        cells = ""
        for cell in COLUMN.findall(body):
            width = f' style="min-width:{len(cell)}ch"' if len(lines) > 1 else ""
            cells += f"<span{width}>{with_scripts(cell.rstrip())}</span>"
        mark = f'<a class="eqno" id="eq-{number}" href="#eq-{number}">({number})</a>' if number else ""
        out.append(f'<div class="line"><div class="body">{cells}</div>{mark}</div>')
    return f'<div class="equation" role="math">{"".join(out)}</div>\n'


def setup(app):
    """Sphinx's entry; its modules are imported here, so that the tests need none of them."""
    from docutils import nodes
    from sphinx import addnodes
    from sphinx.transforms import SphinxTransform

    def link(source, target, number, text):
        """A reference from one page to an equation of another."""
        uri = posixpath.relpath(target, posixpath.dirname(source)) + ".html" if target != source else ""
        return nodes.reference("", text, refuri=f"{uri}#eq-{number}", internal=True)

    class Equations(SphinxTransform):
        """All of the above, on one page."""
        default_priority = 750

        def apply(self, **_):
            self.page = self.env.docname
            theory = self.page.startswith("docs/theory/")
            self.own = self.numbers_of(self.page) if theory else []
            if theory:
                for block in list(self.document.findall(nodes.literal_block)):
                    if block.get("language", "none") in ("none", "default", "text"):
                        block.replace_self(nodes.raw("", display(block.astext()), format="html"))
            for literal in list(self.document.findall(nodes.literal)):
                self.link_file(literal)
            for text in list(self.document.findall(nodes.Text)):
                if not isinstance(text.parent, (nodes.literal, nodes.literal_block, nodes.reference, nodes.raw,
                                                addnodes.download_reference)):
                    self.set_text(text)

        def numbers_of(self, page):
            """Of a page by its name, none if there is no such chapter."""
            path = pathlib.Path(self.env.doc2path(page))
            return numbers(path.read_text(encoding="utf-8")) if path.is_file() else []

        def page_of(self, name):
            """The page that a file's name means here: beside this one, in docs or in the root."""
            if not FILE.match(name):
                return None
            here = posixpath.dirname(self.page)
            for folder in (here, posixpath.join(here, "theory"), "docs", "docs/theory", ""):
                page = posixpath.normpath(posixpath.join(folder, name)).removesuffix(".md")
                if page in self.env.found_docs:
                    return page
            return None

        def link_file(self, literal):
            """`coupling.md` is a link."""
            page = self.page_of(literal.astext())
            if page and page != self.page and not isinstance(literal.parent, (nodes.reference, addnodes.pending_xref)):
                uri = posixpath.relpath(page, posixpath.dirname(self.page)) + ".html"
                reference = nodes.reference("", "", refuri=uri, internal=True)
                literal.replace_self(reference)
                reference += literal

        def set_text(self, text):
            """Scripts and numbers in running text."""
            theory = bool(self.own)
            words, pieces, end = text.astext(), [], 0
            for match in MENTION.finditer(words):
                number, target = match.group(1) or match.group(2), None
                before = words[:match.start()]
                named = self.named_before(text, before)
                if named:
                    target = named if number in self.numbers_of(named) else None
                elif match.group(1) and number in self.own and not FOREIGN.search(before):
                    target = self.page
                if target:
                    pieces += [*self.scripts(words[end:match.start()], theory), link(self.page, target, number, match.group(0))]
                    end = match.end()
            pieces += self.scripts(words[end:], theory)
            if len(pieces) > 1 or not isinstance(pieces[0], nodes.Text):
                parent, place = text.parent, text.parent.index(text)
                parent[place:place + 1] = pieces

        def named_before(self, text, before):
            """The page of a file that is named just before a number: in this text, or as a link that it follows."""
            match = re.search(r"((?:[\w-]+/)*[\w-]+\.md)(?:,| \(|)\s*$", before)
            if match:
                return self.page_of(match.group(1))
            if before.strip(" ,("):
                return None
            place = text.parent.index(text)
            previous = text.parent[place - 1] if place else None
            return self.page_of(previous.astext()) if previous is not None else None

        @staticmethod
        def scripts(words, theory):
            """The text as nodes, K_te and e^{iωt} with their scripts; elsewhere than in theory as it is."""
            pieces, end = [], 0
            for match in INLINE_SCRIPT.finditer(words) if theory else ():
                pieces += [nodes.Text(words[end:match.start(1)]), nodes.raw("", with_scripts(match.group(1)), format="html")]
                end = match.end()
            return [*pieces, nodes.Text(words[end:])]

    app.add_transform(Equations)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
