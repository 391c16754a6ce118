"""Fixtures: the two reducers that come with the software and their FMUs; the order of the files."""

import gc
import os
import signal
from collections import Counter

# Every worker has a core of its own: more threads would wait for each other.  Before NumPy is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Workers and hundreds of short processes import the same files: without kept bytecode each of them compiles these anew, a quarter of its time.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

import pytest
from hypothesis import settings
from shared import made_once
from small_fmus import build_spring

from fmu_src.link import compiler, host_platform
from fmu_src.native import NativeFault, host_triple, object_codes
from fmu_src.package import build_fmu, build_native, triples_for
from reducers.reducer import load_reducer

# Properties: the same few examples at every run; RVWEAR_PROPERTIES=thorough looks at many others.
settings.register_profile("default", max_examples=12, derandomize=True, database=None, deadline=None)
settings.register_profile("thorough", max_examples=1000, deadline=None)
settings.load_profile(os.environ.get("RVWEAR_PROPERTIES", "default"))

# The workers take files in this order: the longest come early, so that no worker is left with one at the end.
FIRST = (
    "test_blind_trial", "test_reproduce", "test_workbench_browser_in", "test_habits", "test_fmu", "test_inference_diagnose", "test_source_fmu", "test_draft", "test_life", "test_wheel", "test_strangers",
    "test_isolation", "test_loop", "test_fmu_bench", "test_effects_check", "test_real_data", "test_references", "test_motion", "test_fuzz_readers",
    "test_checked_file", "test_reducer_unit", "test_verification", "test_plain_python", "test_consoles", "test_ensemble", "test_interrupted",
)  # fmt: skip


def pytest_addoption(parser):
    parser.addoption("--cpu", action="store_true", help="tell at the end what CPU each file took, its processes included")


def pytest_configure(config):
    # Until all tests are collected: what is loaded by then stays.
    gc.disable()
    # A shell that runs tests in the background lets them, and all that they start, ignore Ctrl-C: tests of it would wait for nothing.
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    config.cpu_before = sum(os.times()[:4])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """CPU [s] since the report before: setup, test or teardown, with what they made for others."""
    report = yield
    now = sum(os.times()[:4])
    report.user_properties.append(("cpu", now - item.config.cpu_before))
    item.config.cpu_before = now
    return report


def pytest_terminal_summary(terminalreporter, config):
    if not config.getoption("cpu"):
        return
    files = Counter()
    for reports in terminalreporter.stats.values():
        for report in reports:
            files[getattr(report, "nodeid", "").partition("::")[0]] += sum(value for name, value in getattr(report, "user_properties", ()) if name == "cpu")
    terminalreporter.section(f"{sum(files.values()):.0f} s of CPU")
    for file, seconds in files.most_common():
        if seconds >= 1.0:
            terminalreporter.write_line(f"{seconds:7.1f} s  {file}")


def pytest_collection_finish():
    """What is loaded is not looked through for litter again and again."""
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items):
    place = {name: i for i, name in enumerate(FIRST)}
    items.sort(key=lambda item: place.get(item.path.stem, len(FIRST)))


@pytest.fixture(scope="session")
def rv20e():
    return load_reducer("RV20E-121-rigid")


@pytest.fixture(scope="session")
def bx40e():
    return load_reducer("BX-40E-rigid")


UNITS = {"RvPlant": "rv_plant", "RvWear": "wear_fmu"}


@pytest.fixture(scope="session")
def codes(rv20e, tmp_path_factory):
    """Object code of both units of the RV20E-121 for this machine, by unit and triple."""
    triples = triples_for(False)

    def make(folder):
        for name, unit in UNITS.items():
            (folder / name).mkdir(parents=True, exist_ok=True)
            for triple, code in object_codes(rv20e.specification(unit), triples).items():
                (folder / name / triple).write_bytes(code)

    folder = made_once(tmp_path_factory, "codes", make)
    return {name: {triple: (folder / name / triple).read_bytes() for triple in triples} for name in UNITS}


@pytest.fixture(scope="session")
def fmus(rv20e, codes, tmp_path_factory):
    """Folder with both editable FMUs of the RV20E-121."""
    def make(folder):
        folder.mkdir(exist_ok=True)
        for name, unit in UNITS.items():
            build_fmu(name, rv20e.specification(unit), 1e-3, "rvwear test", folder, codes[name][host_triple()])

    return made_once(tmp_path_factory, "fmus", make)


@pytest.fixture(scope="session")
def native_fmus(rv20e, codes, tmp_path_factory):
    """Folder with the folders fmi2 and fmi3 of the native FMUs of the RV20E-121, for this machine."""
    try:
        compiler(host_platform(), False)
    except NativeFault as fault:
        pytest.skip(f"no native FMUs: {fault}")

    def make(folder):
        folder.mkdir(exist_ok=True)
        for name, unit in UNITS.items():
            build_native(name, rv20e.specification(unit), 1e-3, "rvwear test", folder, codes=codes[name])

    return made_once(tmp_path_factory, "native", make)


@pytest.fixture(scope="session")
def spring(tmp_path_factory):
    """Path of a small FMU."""
    return build_spring(tmp_path_factory.mktemp("spring"))


@pytest.fixture(scope="module")
def shared_runs():
    """Benches of equal models have their runs in common, as in the blind trial: it changes no number, only the time."""
    from discrepancy.prediction.bench import Bench
    from fmu_src.threads import Once

    made, kept = Bench.__init__, {}

    def make(bench, *arguments, **named):
        made(bench, *arguments, **named)
        if type(bench) is Bench:
            model = b"".join(template.tobytes() for template in bench.templates)
            bench.runs = kept.setdefault(model, Once(20_000))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Bench, "__init__", make)
        yield


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    """(folder, address): a server of the workbench in a thread."""
    from workbench_server import started

    from workbench.folder import opened

    folder = opened(tmp_path_factory.mktemp("bench") / "my bench")
    return folder, started(folder)


@pytest.fixture(scope="module")
def chromium():
    """Skipped with a word where something is missing."""
    from browser import CHROMIUM

    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: pip install playwright")
    if CHROMIUM is None:
        pytest.skip("no Chromium: apt-get install chromium")
    with playwright.sync_playwright() as tools:
        browser = tools.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture
def bench(chromium, tmp_path, request):
    """The workbench of an empty folder; nothing may have gone wrong on its page."""
    from browser import Bench

    pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')
    # A diagnosis that is remembered from an earlier run could not be stopped.
    fresh = {"XDG_CACHE_HOME": str(tmp_path / "cache")} if request.node.get_closest_marker("campaign") else {}
    there = Bench(chromium, tmp_path / "bench 1", **fresh)
    yield there
    there.close()
    assert not there.trouble
