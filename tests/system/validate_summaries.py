"""Checks summaries of runs by the published schema: validate_summaries.py SCHEMA SUMMARY ...

Exit 1 if one is not valid, 77 if a module is missing (named on the output).
"""
import json
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError as error:
    print(error)
    sys.exit(77)


def document(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


schema = document(sys.argv[1])
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
failures = 0
for name in sys.argv[2:]:
    for error in validator.iter_errors(document(name)):
        failures += 1
        print(name, error.json_path, error.message[:200])
sys.exit(1 if failures else 0)
