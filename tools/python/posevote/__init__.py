# SPDX-License-Identifier: BSD-3-Clause
"""posevote finds known 3D objects in 3D scans.

>>> import posevote
>>> recognizer = posevote.Recognizer(["part.stl"])
>>> for found in recognizer.detect(points=xyz):
...     print(found.name, found.confidence, found.T)

Lengths that come out are metres; T takes a point of the model's file to the scan's frame.
"""

from ._posevote import Detection, Recognition, Recognizer, __version__

__all__ = ["Detection", "Recognition", "Recognizer", "__version__"]
