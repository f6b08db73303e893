"""Checks case files by a JSON Schema: validate_cases.py SCHEMA GOOD ... --bad BAD ...

Every GOOD must be valid and every BAD must not. Exit 1 if not, 77 if a module is missing (named on the output).
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
for name in good + bad:
    with open(name, "rb") as file:
        errors = list(validator.iter_errors(tomllib.load(file)))
    if bool(errors) != (name in bad):
        failures += 1
        print(name, "is wrongly", "accepted" if name in bad else "refused")
        for error in errors:
            print("  ", error.json_path, error.message[:200])
sys.exit(1 if failures else 0)
