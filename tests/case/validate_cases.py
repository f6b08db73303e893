"""Checks case files by a JSON Schema: validate_cases.py SCHEMA GOOD ... --bad BAD ...

Every GOOD must be valid and every BAD must not; a .json file holds a list of cases. Exit 1 if not, 77 if a module is missing (named on the output).
"""
import json
import sys

try:
    import tomllib

    from jsonschema import Draft202012Validator
except ImportError as error:
    print(error)
    sys.exit(77)

words = sys.argv[2:]
good, bad = words[: words.index("--bad")], words[words.index("--bad") + 1 :]
with open(sys.argv[1], encoding="utf-8") as file:
    schema = json.load(file)
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
failures = 0



def cases_of(name):
    """The cases of a file, each with a name for messages."""
    with open(name, "rb") as file:
        if name.endswith(".json"):
            return [(f"{name}: {json.dumps(case)}", case) for case in json.load(file)]
        return [(name, tomllib.load(file))]


cases = [(title, case, wrong) for wrong, names in ((False, good), (True, bad)) for name in names
         for title, case in cases_of(name)]
for title, case, wrong in cases:
    errors = list(validator.iter_errors(case))
    if bool(errors) != wrong:
        failures += 1
        print(title, "is wrongly", "accepted" if wrong else "refused")
        for error in errors:
            print("  ", error.json_path, error.message[:200])
sys.exit(1 if failures else 0)
