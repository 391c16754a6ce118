"""What the commands of the loop show on the screen."""

from rich.console import Console
from rich.table import Table

from discrepancy.compare import Comparison
from discrepancy.extend import HELPED, Extension
from discrepancy.inference.misfit.localise import Localisation
from discrepancy.model_file import ModelFile
from discrepancy.next_run import NextRun
from discrepancy.scales import shown
from discrepancy.verdict import Answer

LONGEST = 12


def console() -> Console:
    return Console(width=max(Console().width, 120), highlight=False)


def show_warnings(out: Console, warnings: list[str]) -> None:
    for text in warnings:
        out.print(f"[yellow]note[/] {text}", markup=True)


def show_comparison(comparison: Comparison) -> None:
    out = console()
    table = Table(title=f"{comparison.model.file.name} against {comparison.model.campaign.name}", title_justify="left")
    for name in ("signal", "runs", "", "error", "noise", "error/noise"):
        table.add_column(name, justify="left" if name in ("signal", "") else "right")
    for row in comparison.signals:
        colour = "red" if row["ratio"] > 2.0 else "yellow" if row["ratio"] > 1.3 else "green"
        table.add_row(row["signal"], str(row["runs"]), "held out" if row["held_out"] else "fitted", shown(row["error"], row["unit"]),
                      shown(row["noise_floor"], row["unit"]), f"[{colour}]{row['ratio']:.2f}[/]")
    out.print(table)
    if comparison.nuisances:
        out.print("calibrated  " + ", ".join(f"{k} = {v:.6g}" for k, v in comparison.nuisances.items()))
    show_localisation(comparison.diagnostician.localisation, out)
    show_warnings(out, comparison.warnings)


def show_localisation(localisation: Localisation, out: Console | None = None) -> None:
    """Where the misfit is; all tests together at the stated level."""
    out = out or console()
    findings = localisation.findings
    if not findings:
        out.print("[green]no place, order or dependence carries a significant misfit[/]")
        return
    table = Table(title="where the model fails (significant over all tests together)", title_justify="left")
    for name in ("signal", "what", "depends on", "share", "p"):
        table.add_column(name, justify="right" if name in ("share", "p") else "left")
    for g in findings[:LONGEST]:
        table.add_row(g.signal, g.feature, g.dependence, f"{100 * g.share:.0f} %", f"{g.p:.1g}")
    out.print(table)
    if len(findings) > LONGEST:
        out.print(f"and {len(findings) - LONGEST} more: --json lists all")


def show_answer(answer: Answer) -> None:
    out = console()
    out.print(f"verdict  [bold]{answer.verdict}[/]: {answer.diagnosis.reason}")
    for effect in answer.effects:
        variant = f" ({effect['variant'].replace('_', ' ')})" if effect["variant"] else ""
        out.print(f"\n[bold]{effect['name']}[/]{variant}  explains {100 * effect['share_explained']:.0f} % of the misfit")
        for name, number in effect["parameters"].items():
            low, high = number["interval"]
            unit = "" if number["unit"] == "1" else f" {number['unit']}"
            out.print(f"  {name} = {number['value']:.4g}{unit}   95 %: {low:.4g} to {high:.4g}")
        before, after = effect["held_out_error_before"], effect["held_out_error_after"]
        if before is not None:
            out.print(f"  error on unused conditions {before:.2f} -> {after:.2f} times the noise")
    if answer.confusable:
        out.print(f"\nthis campaign cannot tell apart: {', '.join(answer.confusable)}; `rvwear next` proposes what would")
    for name, others in answer.diagnosis.alternatives.items():
        out.print(f"in place of {name} could stand: {', '.join(others)}")
    for law in answer.laws:
        out.print(f"\nlaw without a name: {law.text}")
    rejected = answer.diagnosis.rejected[:6]
    if rejected:
        out.print("\nclosest rivals")
        for rival in rejected:
            out.print(f"  {rival['name']}: {rival['reason']}")
    show_warnings(out, answer.warnings)


def show_extension(extension: Extension) -> None:
    out = console()
    step = extension.step
    colour = "green" if extension.verdict == HELPED else "yellow"
    out.print(f"{' + '.join(step['effects'])}: [bold {colour}]{extension.verdict}[/]; {step['reason']}")
    for row in step["signals"]:
        where = "held out" if row["held_out"] else "fitted"
        out.print(f"  {row['signal']} ({where}): {shown(row['before'], row['unit'])} -> {shown(row['after'], row['unit'])},"
                  f" noise {shown(row['noise_floor'], row['unit'])}")


def show_ladder(file: ModelFile) -> None:
    out = console()
    if not file.steps:
        out.print(f"{file.name} has no steps yet: rvwear extend adds them")
        return
    table = Table(title=f"{file.name}: error over noise, step by step", title_justify="left")
    for name in ("step", "campaign", "fitted runs", "unused runs", "verdict"):
        table.add_column(name, justify="left")
    for step in file.steps:
        unused = "-" if step.get("held_out_before") is None else f"{step['held_out_before']:.2f} -> {step['held_out_after']:.2f}"
        table.add_row(" + ".join(step["effects"]), step["campaign"], f"{step['training_before']:.2f} -> {step['training_after']:.2f}",
                      unused, step["verdict"] + ("" if step.get("kept", True) else ", not kept"))
    out.print(table)


def show_next(run: NextRun) -> None:
    out = console()
    out.print(run.verdict)
    if run.result is None:
        return
    table = Table(title=f"to separate {', '.join(run.rivals)}", title_justify="left")
    for name in ("experiment", "cost", "least separation", "mean separation"):
        table.add_column(name, justify="left" if name == "experiment" else "right")
    for p in run.result.proposals[:LONGEST]:
        table.add_row(p.experiment, f"{p.cost:g}", f"{p.least:.1f}", f"{p.score:.1f}")
    out.print(table)
    for name, size in run.result.at_stake.items():
        out.print(f"what it costs not to know: at {name} the rivals differ by up to {size:.3g} (SI unit)")
