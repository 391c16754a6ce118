"""Start values of whole arrays in a specification, as text.

A worn reducer starts with thousands of depths: they travel with the FMU as its other start values
do, packed, and are the same bits everywhere.
"""

import base64
import binascii
import zlib

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Floats


def encode(values: npt.ArrayLike) -> str:
    """A number or an array of floats as text."""
    numbers = np.ascontiguousarray(values, "<f8").reshape(-1, 1)
    # Bytes of one significance side by side: neighbours are alike.
    return base64.b64encode(zlib.compress(numbers.view("u1").T.tobytes(), 9)).decode()


def decode(text: str, shape: tuple[int, ...]) -> Floats:
    """The array in a text of ``encode``; ValueError if it is none, or of another size."""
    try:
        packed = np.frombuffer(zlib.decompress(base64.b64decode(text, validate=True)), "u1")
        return np.ascontiguousarray(packed.reshape(8, -1).T).view("<f8").reshape(shape)
    except (zlib.error, binascii.Error, ValueError) as problem:
        raise ValueError(f"start values of an array of shape {shape}: {problem}") from None
