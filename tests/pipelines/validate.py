# SPDX-License-Identifier: BSD-3-Clause
"""python3 validate.py SCHEMA FILE: 0 if the file is as the schema says, else what is wrong."""

import json
import sys

import jsonschema

schema, document = (json.load(open(file, encoding="utf-8")) for file in sys.argv[1:3])
jsonschema.Draft202012Validator.check_schema(schema)
problems = list(jsonschema.Draft202012Validator(schema).iter_errors(document))
for problem in problems:
    print("/".join(str(part) for part in problem.absolute_path), problem.message[:200])
sys.exit(len(problems) > 0)
