"""Write the JSON Schema of scenario files, which is kept in the package."""

from __future__ import annotations

import json
from pathlib import Path

import coplanar.scenarios
from coplanar.scenarios import schema

path = Path(coplanar.scenarios.__file__).with_name("schema.json")
path.write_text(json.dumps(schema(), indent=1) + "\n", "utf-8")
print(path)
