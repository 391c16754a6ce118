"""What goes into the wheel; everything else about the project stands in ``pyproject.toml``, which cannot say this.

Packages are all folders of the parts below, with their data files.  The examples lie in ``examples/``, a name that is
everybody's: installed they are ``rvwear_examples``, from where ``rvwear example`` copies them.
"""

from setuptools import find_namespace_packages, setup

PARTS = (
    "cli", "discrepancy", "exports", "fmu_src", "orchestrator", "pages", "reducers", "reproduce", "rv_plant", "rv_reducer", "rvwear", "studies",
    "wear_fmu", "workbench",
)  # fmt: skip
LITTER = ["__pycache__/*", "*.py[co]"]
EXAMPLES = "rvwear_examples"

inside = find_namespace_packages(include=[*PARTS, *(f"{part}.*" for part in PARTS)], exclude=["*.__pycache__"])
shown = find_namespace_packages("examples", exclude=["*__pycache__"])
setup(
    packages=[*inside, EXAMPLES, *(f"{EXAMPLES}.{name}" for name in shown)],
    package_dir={EXAMPLES: "examples"},
    package_data={
        "": ["*.c", "*.h", "*.toml", "*.css", "*.html", "*.js"],
        **{name: ["*"] for name in (EXAMPLES, *(f"{EXAMPLES}.{name}" for name in shown))},
    },
    exclude_package_data={"": LITTER},
)
