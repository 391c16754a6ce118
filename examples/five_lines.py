"""The pair of FMUs from its package: rvwear build --output dist, then python examples/five_lines.py"""

import rvwear

system = rvwear.load_system("dist/RvReducer.ssp")
system["wear.acceleration"] = 1e6
system["plant.output.load_torque"] = "150 N.m"
series = system.run(duration=0.2, record=["plant.output.lag", "wear.flank.depth"])
print(f"lag {series['plant.output.lag'][-1]:.4g} rad, deepest flank {series['wear.flank.depth'][-1].max():.3g} m")
