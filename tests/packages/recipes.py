#!/usr/bin/env python3
"""Reads the recipes for Spack, conda, EasyBuild and containers, and the workflow for GitHub, which nothing here can run.
They must be correct YAML or Python, have the project's version, and name existing files, options and presets. Containers install
the same packages as docs/relink.md.

  recipes.py ROOT
"""
import re
import sys
from pathlib import Path

import yaml

ROOT = Path(sys.argv[1])
project = (ROOT / "CMakeLists.txt").read_text()
version = "".join(re.search(pattern, project)[1] for pattern in (r"project\(pstripack VERSION (\S+)",
                                                                 r"set\(PSTRIPACK_CANDIDATE ?(\S*)\)"))
options = set(re.findall(r"(?m)^option\((\w+)", project))

conda = yaml.safe_load((ROOT / "packaging/conda/recipe.yaml").read_text())
assert conda["context"]["version"] == version.replace("-", ""), conda["context"]
assert (ROOT / "packaging/conda" / conda["source"]["path"]).resolve() == ROOT.resolve()
for file in [conda["about"]["license_file"], *conda["tests"][0]["files"]["source"]]:
    assert (ROOT / file).is_file(), file

[recipe] = (ROOT / "packaging/easybuild").glob("*.eb")
names = {"SOURCELOWER_TAR_GZ": f"pstripack-{version}.tar.gz", "SHLIB_EXT": "so"}
exec(compile(recipe.read_text(), recipe, "exec"), names)
assert names["version"] == version
assert recipe.name == f"pstripack-{version}-{names['toolchain']['name']}-{names['toolchain']['version']}.eb"

spack = ROOT / "packaging/spack/package.py"
text = spack.read_text()
compile(text, spack, "exec")
assert f'version("{version}")' in text and f"pstripack@{version}" in text
least = re.search(r"cmake_minimum_required.VERSION ([0-9.]+[0-9])[.]{3}", project)[1]
assert f'"cmake@{least}:"' in text
used = set(re.findall(r'"(PSTRIPACK_[A-Z_]+)"', text))
assert used and used <= options | {"PSTRIPACK_PYTHON_DIR"}, f"{spack}: no such options: {used - options}"

containers = [ROOT / "packaging/containers" / name for name in ("Dockerfile", "pstripack.def")]
told = set(re.search(r"apt-get install -y (g\+\+.*?)\ncmake", (ROOT / "docs/relink.md").read_text(), re.DOTALL)[1].split())
for container in containers:
    text = container.read_text()
    assert told <= set(text.split()), f"{container}: lacks {told - set(text.split())}"
    assert "cmake --workflow --preset packages" in text

workflow = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text())
commands = [step["run"] for job in workflow["jobs"].values() for step in job["steps"] if "run" in step]
scripts = [command.split()[0] for command in commands if "/" in command.split()[0]]
assert scripts == [".ci/run", "./test.sh"] and all((ROOT / script).is_file() for script in scripts), scripts

for file in [ROOT / "packaging/conda/recipe.yaml", recipe]:
    used = set(re.findall(r"-D(PSTRIPACK_\w+)", file.read_text()))
    assert used and used <= options, f"{file}: no such options: {used - options}"
print("Spack, conda, EasyBuild, containers, workflow: read")
