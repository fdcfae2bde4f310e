"""Compares JSON Schemas with what mezha says of the same texts: tests/schema.rs calls it and tells more.

Arguments are names and files of schemas, `case=docs/case.schema.json`. Each line of the standard input is a JSON object with `kind`,
`text`, whether the program `accepts` it, and whether its `form` is right.
"""

import json
import math
import sys
import tomllib

import jsonschema

# TOML has integers and floats, of which JSON knows nothing: to most validators 2.0 is a whole number, to mezha it is not.
whole = jsonschema.Draft202012Validator.TYPE_CHECKER.redefine(
    "integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool)
)
Validator = jsonschema.validators.extend(jsonschema.Draft202012Validator, type_checker=whole)


def as_json(value):
    """A value of TOML as JSON has it, which has no numbers that are not finite."""
    if isinstance(value, dict):
        return {key: as_json(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [as_json(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


validators = {}
for argument in sys.argv[1:]:
    kind, file = argument.split("=")
    with open(file, encoding="utf-8") as text:
        schema = json.load(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    validators[kind] = Validator(schema)

count = dict.fromkeys(["texts", "of no TOML", "accepted", "refused by form", "refused by the program alone"], 0)
wrong = []
for line in sys.stdin:
    case = json.loads(line)
    count["texts"] += 1
    try:
        table = as_json(tomllib.loads(case["text"]))
    except (tomllib.TOMLDecodeError, RecursionError):
        count["of no TOML"] += 1
        continue
    if case["form"] is None:  # The program's own reader of TOML refuses it.
        count["of no TOML"] += 1
        continue
    error = jsonschema.exceptions.best_match(validators[case["kind"]].iter_errors(table)) if case["explain"] else None
    valid = error is None if case["explain"] else validators[case["kind"]].is_valid(table)
    count["refused by form" if not valid else "accepted" if case["accepts"] else "refused by the program alone"] += 1
    if case["accepts"] and not valid:
        wrong.append(("the schema refuses what the program accepts", case, error))
    elif valid != case["form"]:
        wrong.append((f"the schema says {valid}, the form is {case['form']}", case, error))

print(", ".join(f"{number} {name}" for name, number in count.items()))
for words, case, error in wrong[:5]:
    print(f"--- {words}: {error.message if error else ''}\n{case['text']}")
sys.exit(min(len(wrong), 1))
