"""The plant's kernels take no more instructions than they did: counts by callgrind, which repeat exactly."""

import json

import pytest

from benchmarks.instructions import KEPT, counted
from benchmarks.limit import available, kernel_name

# Compilers and libm of other machines take their part.
MARGIN = 1.25


def test_names_of_kernels_are_read():
    assert kernel_name("rv_plant.mesh.mesh_contacts.47") == "mesh.mesh_contacts"
    assert kernel_name("__cos_fma") == "__cos_fma"


@pytest.mark.callgrind
@pytest.mark.skipif(not available(), reason="needs valgrind, gcc and objdump")
def test_no_more_instructions_than_before():
    kept, now = json.loads(KEPT.read_text()), counted()
    assert kept.keys() == now.keys()
    assert {name: n / kept[name] for name, n in now.items() if n > MARGIN * kept[name]} == {}
