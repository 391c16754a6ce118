"""Values of all contacts between discs and pins and of all rollers, as the two arrays that hold them."""

from fmu_src.kernel import kernel


@kernel
def copy_contacts(meshes, rollers, to_meshes, to_rollers):
    """One value for each contact [disc, pin] and for each roller [disc, crank, roller] into arrays of the same shapes."""
    discs, cranks, count = rollers.shape
    for d in range(discs):
        for j in range(meshes.shape[1]):
            to_meshes[d, j] = meshes[d, j]
        for c in range(cranks):
            for k in range(count):
                to_rollers[d, c, k] = rollers[d, c, k]
