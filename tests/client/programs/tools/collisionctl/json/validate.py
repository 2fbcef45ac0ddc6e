#!/usr/bin/python3
"""validate.py SCHEMA FILE: one line for each document (a line of FILE) that the schema refuses."""
import json
import sys

import jsonschema


def without_duplicates(pairs):
    if len({key for key, _ in pairs}) < len(pairs):
        raise ValueError("a key twice in " + str([key for key, _ in pairs]))
    return dict(pairs)


def no_constant(text):
    raise ValueError(text)


def causes(error):
    """Of the alternatives the one that fits best says why."""
    best = jsonschema.exceptions.best_match([error])
    return "/".join(str(part) for part in best.absolute_path) + ": " + best.message


with open(sys.argv[1]) as file:
    schema = json.load(file)
jsonschema.Draft202012Validator.check_schema(schema)
with open(sys.argv[2]) as file:
    for number, line in enumerate(file, 1):
        try:
            document = json.loads(line, object_pairs_hook=without_duplicates,
                                  parse_constant=no_constant)
        except ValueError as error:
            print(f"{number}: {error}")
            continue
        # Against the definition of its kind, so that the message names the cause.
        name = str(document.get("kind", "")).replace("-", "_") + "_document"
        if name not in schema["$defs"]:
            print(f"{number}: kind: {document.get('kind')!r}")
            continue
        one = {"$ref": "#/$defs/" + name, "$defs": schema["$defs"]}
        for error in jsonschema.Draft202012Validator(one).iter_errors(document):
            print(f"{number}: {causes(error)}")
        if not jsonschema.Draft202012Validator(schema).is_valid(document):
            print(f"{number}: refused as a whole")
