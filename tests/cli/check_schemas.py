#!/usr/bin/env python3
"""Checks JSON documents against JSON Schemas: check_schemas.py SCHEMA DOCUMENT [SCHEMA DOCUMENT…]

Prints a list as JSON, with one object for each document: `fault` is empty if the document follows its schema. Then
`accepted` names the mistakes that the schema does not find: a misspelt member, a value of another type.
"""

import json
import sys

import jsonschema

LONGEST = 8  # values in arrays of values, in which mistakes are tried


def shape(value):
    """Returns what distinguishes kinds of objects in an array: their members, types and commands."""
    if not isinstance(value, dict):
        return type(value)
    return tuple((key, type(one), one if key == "do" else "") for key, one in sorted(value.items()))


def shortened(value):
    """Returns a document with one object of each kind in each array, and with short arrays of values."""
    if isinstance(value, dict):
        return {key: shortened(one) for key, one in value.items()}
    if not isinstance(value, list):
        return value
    if all(isinstance(one, dict) for one in value):
        return [shortened(one) for one in {shape(one): one for one in reversed(value)}.values()]
    return [shortened(one) for one in value[:LONGEST]]


def of_another_type(value):
    if isinstance(value, str):
        return 7
    if isinstance(value, bool) or isinstance(value, (int, float)):
        return "text"
    return {} if isinstance(value, list) else [] if isinstance(value, dict) else True


def mistakes(value, path=()):
    """Makes one mistake after another in the document, and takes it back. Yields its path."""
    keys = list(value) if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else []
    for key in keys:
        if path + (key,) == ("ui",):  # free: only the window reads it
            continue
        right = value[key]
        value[key] = of_another_type(right)
        yield path + (key,)
        value[key] = right
        if isinstance(value, dict):
            del value[key]
            value[str(key) + "x"] = right
            yield path + (str(key) + "x",)
            del value[str(key) + "x"]
            value[key] = right
        yield from mistakes(right, path + (key,))


def checked(validator, document):
    fault = jsonschema.exceptions.best_match(validator.iter_errors(document))
    if fault is not None:
        return {"fault": "/".join(map(str, fault.absolute_path)) + ": " + fault.message[:300], "accepted": []}
    document = shortened(document)
    accepted = ["/".join(map(str, path)) for path in mistakes(document) if validator.is_valid(document)]
    return {"fault": "", "accepted": accepted}


def validator_of(path):
    with open(path, encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def main():
    validators = {path: validator_of(path) for path in set(sys.argv[1::2])}
    results = []
    for schema, path in zip(sys.argv[1::2], sys.argv[2::2]):
        with open(path, encoding="utf-8") as file:
            results.append(checked(validators[schema], json.load(file)))
    print(json.dumps(results))


main()
