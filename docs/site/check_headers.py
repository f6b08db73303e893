#!/usr/bin/env python3
"""Every public function, class and enumeration of the library's headers has a comment, as Doxygen read them.

    check_headers.py XML     the folder that Doxygen wrote; prints one line for each that has none; exit 1 if there is any

Held to it: free functions, classes, structs, enumerations, aliases and public member functions. Not: constructors, destructors,
operators, what is defaulted or deleted, overrides (the base says it), and data members, whose type or name may say enough.
"""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def described(element):
    """Whether there is any text about it."""
    return any("".join(element.find(tag).itertext()).strip() for tag in ("briefdescription", "detaileddescription")
               if element.find(tag) is not None)


def place(element):
    """Its file and line."""
    location = element.find("location")
    return f"{location.get('file')}:{location.get('line')}"


def exempt(member, class_name):
    """Members that say by their kind what they do."""
    name = member.findtext("name")
    args = (member.findtext("argsstring") or "").replace(" ", "")
    return (name.lstrip("~") == class_name or name.startswith("operator") or args.endswith(("=default", "=delete"))
            or member.find("reimplements") is not None)


def main():
    counts, missing, seen = {"functions": 0, "types": 0}, [], set()
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.xml")):
        compound = ElementTree.parse(path).getroot().find("compounddef")
        if compound is None:
            continue
        kind, name = compound.get("kind"), compound.findtext("compoundname")
        if kind in ("class", "struct", "union"):
            if compound.get("prot") != "public" or name.startswith("Eigen"):
                continue
            counts["types"] += 1
            if not described(compound):
                missing.append(f"{place(compound)}: {kind} {name}")
        elif kind != "namespace":
            continue
        for member in compound.iter("memberdef"):
            what = member.get("kind")
            if what not in ("function", "enum", "typedef") or member.get("prot") != "public" or member.get("id") in seen:
                continue
            seen.add(member.get("id"))
            if kind != "namespace" and (what == "typedef" or exempt(member, name.split("::")[-1].split("<")[0])):
                continue
            counts["functions" if what == "function" else "types"] += 1
            if not described(member):
                missing.append(f"{place(member)}: {what} {member.findtext('name')}{member.findtext('argsstring') or ''}")
    print("\n".join(sorted(missing)), end="\n" if missing else "")
    print(f"{counts['functions']} public functions and {counts['types']} types; without a comment: {len(missing)}")
    return 1 if missing or not counts["functions"] else 0


if __name__ == "__main__":
    sys.exit(main())
