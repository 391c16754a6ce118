# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     name: python3
# ---

# %% [markdown]
# # A reducer in five lines
# The package of both units, made by `rvwear build --flavour native --fmi 2 --output dist`: plant and wear, connected.

# %%
import rvwear

system = rvwear.load_system("dist/fmi2/RvReducer.ssp")
system["wear.acceleration"] = 1e6
system["plant.output.load_torque"] = "150 N.m"
series = system.run(duration=0.2, record=["plant.output.lag", "wear.flank.depth"])

# %% [markdown]
# The carrier falls behind while the flanks wear: wear counts a million times, so that 0.2 s are 56 h.

# %%
print(f"lag {series['plant.output.lag'][-1]:.2g} rad, deepest flank {series['wear.flank.depth'][-1].max():.1g} m")

# %% [markdown]
# Without a build: a crank turn in this process, as an xarray dataset, and a picture of the loop of stiffness.

# %%
turn = rvwear.solve("RV20E-121", positions=24)
loop = rvwear.hysteresis("RV20E-121", steps=8, angles=1)
rvwear.figure(loop)
