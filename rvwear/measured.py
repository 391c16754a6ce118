"""A model against measurements."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from discrepancy import compare as comparing
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Campaign
from discrepancy.model_file import ModelFile, load_model
from discrepancy.tables import tables_of

if TYPE_CHECKING:
    from discrepancy.verdict import Answer


def inputs(model: ModelFile | str | Path, campaign: Campaign | str | Path) -> tuple[ModelFile, Campaign]:
    file = model if isinstance(model, ModelFile) else load_model(model)
    measured = campaign if isinstance(campaign, Campaign) else load_campaign(campaign)
    measured.require_fittable()
    return file, measured


class Shown:
    """What comparison and diagnosis have in common."""

    def __init__(self, result: "comparing.Comparison | Answer"):
        self._result = result

    @property
    def tables(self) -> dict[str, pd.DataFrame]:
        """Everything by name, in the units of a bench; heads say them."""
        return {table.name: table.frame() for table in tables_of(self._result)}

    @property
    def key_figures(self) -> pd.DataFrame:
        """Stiffness, lost motion, transmission error by order ...: measured, of the model, noise, and how far they are off in times the noise."""
        return self.tables["key_figures"]

    @property
    def warnings(self) -> list[str]:
        return list(dict.fromkeys(self._result.warnings))

    def as_json(self) -> dict[str, Any]:
        """As the command prints it with ``--json``, in SI units."""
        return self._result.as_json()

    def write_html(self, path: str | Path) -> Path:
        """The page of the result, one file that opens offline."""
        from discrepancy.page import write_page

        return write_page(self._result, Path(path))


class Comparison(Shown):
    """Measured against predicted; see ``compare``."""

    @property
    def runs(self) -> pd.DataFrame:
        """A row a run: ``error`` and ``noise_floor`` (root mean squares in ``unit``) and their ``ratio``."""
        return self.tables["runs"]

    @property
    def signals(self) -> pd.DataFrame:
        """The same by signal, fitted and held-out runs apart."""
        return self.tables["signals"]

    def __repr__(self) -> str:
        rows = self.signals
        worst = rows.sort_values("ratio").iloc[-1]
        return f"<Comparison of {len(self.runs)} runs: {worst['signal']} errs by {worst['ratio']:.3g} times its noise>"


@dataclass(frozen=True)
class Named:
    """An effect that a diagnosis names: its variant, and its parameters with their 95 % intervals, a row each."""

    name: str
    variant: str
    parameters: pd.DataFrame


class Diagnosis(Shown):
    """Which effect the model lacks; see ``diagnose``."""

    _result: "Answer"

    @property
    def verdict(self) -> str:
        """``no discrepancy``, ``one effect``, ``set``, ``several effects``, ``unknown`` ... (docs/diagnosis.md)."""
        return self._result.verdict

    @property
    def reason(self) -> str:
        return self._result.reason

    @property
    def effects(self) -> list[Named]:
        """What is named; empty where nothing is."""
        frame = self.tables.get("effects")
        if frame is None:
            return []
        return [Named(str(name), str(variant), rows.reset_index(drop=True)) for (name, variant), rows in frame.groupby(["effect", "variant"], sort=False)]

    @property
    def rivals(self) -> pd.DataFrame:
        """What was looked at and rejected, with the reason."""
        return self.tables["rivals"]

    def __repr__(self) -> str:
        return f"<Diagnosis: {self.verdict}{': ' if self.effects else ''}{', '.join(effect.name for effect in self.effects)}>"


def compare(model: ModelFile | str | Path, campaign: Campaign | str | Path, *, jobs: int = 1) -> Comparison:
    """Hold a model against a campaign: error against noise per signal and condition.

    ``model``: a model file, a reducer file, or the name of a reducer; ``campaign``: a folder with ``campaign.toml`` (docs/campaigns.md);
    ``jobs``: threads.  InputFault says what is wrong with a file, and where.

    >>> import rvwear
    >>> found = rvwear.compare("RV20E-121-rigid", "examples/hidden_effect/campaign")
    >>> found
    <Comparison of 26 runs: hysteresis[locked=input] errs by 2.24 times its noise>
    >>> list(found.key_figures.columns[:5])
    ['signal', 'condition', 'figure', 'measured', 'model']
    """
    return Comparison(comparing.compare(*inputs(model, campaign), jobs=jobs))


def diagnose(model: ModelFile | str | Path, campaign: Campaign | str | Path, *, jobs: int = 1) -> Diagnosis:
    """Which physical effect a model lacks: none, one, a set that cannot be told apart, several, or an unknown one (docs/diagnosis.md).

    Takes minutes; the answer is kept, and given at once when model, campaign and program are the same.

    >>> import rvwear
    >>> found = rvwear.diagnose("RV20E-121-rigid", "examples/hidden_effect/campaign")
    >>> found
    <Diagnosis: one effect: thermal_expansion>
    >>> found.effects[0].parameters[["parameter", "unit"]].values.tolist()
    [['effects.thermal_expansion.expansion', '1/K']]
    """
    from discrepancy.remembered import diagnosed

    return Diagnosis(diagnosed(*inputs(model, campaign), jobs=jobs))
