"""Hostile values of every key of a case: the keys and their types are those of `thinwall schema`."""

import copy
import math
import tomllib
import zlib

from bases import Raw, toml_of
from judge import Input
from jsonschema import Draft202012Validator

FILE = "hostile.toml"  # the case of an input, beside the data of its base


def leaves(schema, path=()):
    """(path, schema) of every key that holds a value; "[]" is any entry of a list, "*" any name."""
    for key, below in schema.get("properties", {}).items():
        if "properties" in below.get("items", {}):
            yield from leaves(below["items"], (*path, key, "[]"))
        elif "properties" in below:
            yield from leaves(below, (*path, key))
            for named in below.get("patternProperties", {}).values():
                yield from leaves(named, (*path, key, "*"))
        else:
            yield (*path, key), below


def tables(schema, path=()):
    """Paths of all tables and lists of tables."""
    for key, below in schema.get("properties", {}).items():
        if "properties" in below.get("items", {}):
            yield (*path, key), True
            yield from tables(below["items"], (*path, key, "[]"))
        elif "properties" in below:
            yield (*path, key), False
            yield from tables(below, (*path, key))
            for named in below.get("patternProperties", {}).values():
                yield (*path, key, "*"), False
                yield from tables(named, (*path, key, "*"))


def found_at(case, path):
    """(the table that holds the last key, the path with numbers and names), or None; entries with the key are preferred."""
    if len(path) == 1:
        return (case, path) if isinstance(case, dict) else None
    head, rest = path[0], path[1:]
    if head == "[]":
        options = list(enumerate(case)) if isinstance(case, list) else []
    elif head == "*":
        options = list(case.items()) if isinstance(case, dict) else []
    else:
        options = [(head, case[head])] if isinstance(case, dict) and head in case else []
    places = [(at[0], (name, *at[1])) for name, below in options if (at := found_at(below, rest))]
    return next((place for place in places if path[-1] in place[0]), places[0] if places else None)


def base_with(cases, path):
    """The first base that has the key; else one that has its table, at whatever depth it begins."""
    places = [(name, at) for name, (_, case) in cases.items() if (at := found_at(case, path))]
    return next(((name, at) for name, at in places if path[-1] in at[0]), places[0] if places else None)


def dotted(path):
    """points.P.at, part.supports[0].on"""
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path).lstrip(".")


def with_value(case, path, value):
    """A copy of a case with another value at a path."""
    result = copy.deepcopy(case)
    table = result
    for part in path[:-1]:
        table = table[part]
    table[path[-1]] = value
    return result


def alternatives(leaf):
    """The simple schemas of which a value has to obey one; `list` ones have items."""
    for each in leaf.get("anyOf", [leaf]):
        if "anyOf" in each:
            yield from alternatives(each)
        else:
            yield each


def numeric(leaf):
    """The schema of the number that a key takes, or that its entries are; None if it is no number."""
    simple = list(alternatives(leaf))
    entries = [entry for each in simple if "items" in each for entry in alternatives(each["items"])]
    entries += [deep for each in entries if "items" in each for deep in alternatives(each["items"])]
    numbers = [each for each in simple + entries if each.get("type") in ("number", "integer")]
    return numbers[0] if numbers else None


def beyond(number):
    """Numbers that lie outside of the bounds by a little."""
    whole = number.get("type") == "integer"
    for key, sign in (("minimum", -1), ("exclusiveMinimum", -1), ("maximum", 1), ("exclusiveMaximum", 1)):
        if key not in number:
            continue
        bound = number[key]
        if whole:
            yield int(bound) + sign
        elif key.startswith("exclusive"):
            yield float(bound)
        else:
            # A part in a million: bounds are printed with ten digits, and angles have their unit's rounding.
            yield bound + sign * 1e-6 * (abs(bound) or 1.0)


LONG = "w" * 5000
COMMON = (
    ("a truth value", Raw("true")), ("empty text", ""), ("a date", Raw("1979-05-27")), ("a table", Raw("{ a = 1 }")),
    ("an empty list", Raw("[]")), ("a list in a list", Raw('[["a"], [[1]]]')), ("a long word", LONG),
    ("control characters", "a\x07\x1b[31m\x00"), ("not ASCII", "ä€\U0001f600\u202e"),
)
NUMBERS = (
    ("nan", Raw("nan")), ("inf", Raw("inf")), ("-inf", Raw("-inf")), ("negative", Raw("-1.5")), ("zero", Raw("0")),
    ("1e-300", Raw("1e-300")), ("1e300", Raw("1e300")), ("nan with a unit", "nan m"), ("beyond a double", "1e400"),
    ("unknown unit", "5 furlong"), ("a unit twice", "5 m m m"), ("a unit of another kind", "5 mol"), ("candela", "5 K"),
    ("electric", "5 m^17"), ("text", "many"), ("number and text", "5 5"), ("a comma", "1,5"), ("hexadecimal", "0x1p-3"),
)
WHOLE = (("a fraction", Raw("1.5")), ("beyond 64 bits", Raw("99999999999999999999")), ("largest", Raw("9223372036854775807")),
         ("smallest", Raw("-9223372036854775808")), ("negative", Raw("-1")), ("nan", Raw("nan")), ("inf", Raw("inf")))

NOT_TOML = ("beyond 64 bits",)  # a line of the file is named, since the reader of TOML knows no keys yet


def python_of(value):
    """The value that TOML makes of a text, for the validator; what JSON cannot hold is None."""
    if not isinstance(value, Raw):
        return value
    try:
        read = tomllib.loads(f"x = {value}")["x"]
    except (tomllib.TOMLDecodeError, ValueError):
        return None
    if isinstance(read, float) and not math.isfinite(read):
        return None
    return read if isinstance(read, (bool, int, float, str, list, dict)) else None


def hostile_values(leaf):
    """(name, value, whether nothing but a refusal is right) for a key."""
    validator = Draft202012Validator(leaf)
    words = [word for each in alternatives(leaf) for word in each.get("enum", ())]
    number = numeric(leaf)
    listed = any("items" in each for each in alternatives(leaf))
    free_text = any(each.get("type") in ("string", ["number", "string"]) and "pattern" not in each
                    for each in alternatives(leaf))
    values = list(COMMON)
    if number:
        values += WHOLE if number.get("type") == "integer" else NUMBERS
        values += [(f"beyond a bound, {value:g}", Raw(repr(value))) for value in beyond(number)]
    if listed:
        values += [(f"{name}, in a list", Raw(f"[{text}, {text}, {text}]"))
                   for name, text in (("nan", "nan"), ("text", '"many"'), ("true", "true"), ("empty text", '""'))]
        values += [("one entry", Raw("[1]")), ("very many entries", Raw("[" + "1, " * 3000 + "]"))]
        if number:
            values += [(f"beyond a bound, {value:g}, in a list", Raw(f"[{value!r}, {value!r}, {value!r}]"))
                       for value in beyond(number)]
    if words:
        values += [("an unknown word", "unheard_of"), ("a capital", str(words[0]).capitalize() + "X"), ("a number", Raw("7"))]
    if free_text:
        values += [("no such name", "no_such_name_or_file"), ("a folder", "."), ("a number", Raw("7")), ("far above", "../" * 50)]
    for name, value in values:
        read = python_of(value)
        wrong = read is None or not validator.is_valid(read)
        if free_text and isinstance(read, str):
            wrong = False
        elif number and isinstance(read, str) and read not in words:
            wrong = True
        if name == "inf" and "inf" in words:
            wrong = False
        yield name, value, wrong


def inputs(schema, cases):
    """An input for each hostile value of each key, half of them by --set where that can be."""
    for path, leaf in leaves(schema):
        base = base_with(cases, path)
        if base is None:
            raise LookupError("no base has the table of " + ".".join(path) + "; add one to tests/hostile/bases.py")
        name, (_, place) = base
        key = dotted(place)
        for what, value, refused in hostile_values(leaf):
            title = f"{key}: {what}"
            by_option = zlib.crc32(title.encode()) % 2 and "\0" not in str(value)
            if by_option:
                words, files = ["check", ".", "--set", f"{key}={value}"], {}
            else:
                words, files = ["check", FILE], {FILE: toml_of(with_value(cases[name][1], place, value)).encode()}
            named = (key, *((FILE + ":",) if what in NOT_TOML else ()), *(() if refused else (dotted(place[:1]), str(value)[:40])))
            yield Input(title, words, name, files, named, refused, (3,) if refused else (3, 4))
    for path, listed in tables(schema):
        yield from of_table(cases, path, listed)


def of_table(cases, path, listed):
    """A table that is no table, or has a key that nobody knows."""
    name, (holder, place) = base_with(cases, path)
    if place[-1] == "*":
        place = (*place[:-1], next(iter(holder)))
    key = dotted(place)
    for what, value in (("a number", Raw("7")), ("text", "word"), ("a list of numbers", Raw("[1, 2]"))):
        yield Input(f"{key}: {what} for a table", ["check", FILE], name,
                    {FILE: toml_of(with_value(cases[name][1], place, value)).encode()}, (key,), True)
    table = holder.get(place[-1], {})
    unknown = [{**table[0], "unheard_of": 1}, *table[1:]] if listed and table else {**(table or {}), "unheard_of": 1}
    yield Input(f"{key}: a key that nobody knows", ["check", FILE], name,
                {FILE: toml_of(with_value(cases[name][1], place, unknown)).encode()}, ("unheard_of", key), True)
