"""Print what a pyproject.toml asks for: build requirements, dependencies and an extra, if named.

`make setup` installs these before the first build, because the build runs without isolation and
pip cannot install a project's requirements without building the project.
"""

import sys
import tomllib
from pathlib import Path


def requirements(table: dict, extra: str) -> list[str]:
    project = table["project"]
    nested = {f"{project['name']}[{name}]": name for name in project["optional-dependencies"]}
    found = list(table["build-system"]["requires"]) + list(project["dependencies"])
    todo = [extra] if extra else []
    while todo:
        for requirement in project["optional-dependencies"][todo.pop()]:
            if requirement in nested:
                todo.append(nested[requirement])
            else:
                found.append(requirement)
    return sorted(set(found))


if __name__ == "__main__":
    path, extra = sys.argv[1], "".join(sys.argv[2:])
    print("\n".join(requirements(tomllib.loads(Path(path).read_text()), extra)))
