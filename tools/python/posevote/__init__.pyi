# SPDX-License-Identifier: BSD-3-Clause
import os
from typing import Any, Iterator, Mapping, Optional, Sequence, Union, overload

import numpy as np
import numpy.typing as npt

__version__: str

Path = Union[str, "os.PathLike[str]"]
Model = Union[Path, npt.NDArray[Any], Mapping[str, Any], Any]

class Detection:
    @property
    def name(self) -> str: ...
    @property
    def obj_id(self) -> int: ...
    @property
    def confidence(self) -> float: ...
    @property
    def pose_confidence(self) -> float: ...
    @property
    def look_alikes(self) -> list[tuple[npt.NDArray[np.float64], float]]: ...
    @property
    def T(self) -> npt.NDArray[np.float64]: ...
    @property
    def covariance(self) -> Optional[npt.NDArray[np.float64]]: ...
    @property
    def symmetries(self) -> list[npt.NDArray[np.float64]]: ...
    @property
    def axes(self) -> list[list[float]]: ...
    @property
    def axis_point(self) -> list[float]: ...
    @property
    def inlier_share(self) -> float: ...
    @property
    def rms(self) -> float: ...
    @property
    def seconds(self) -> float: ...

class Recognition(Sequence[Detection]):
    @property
    def found(self) -> list[Detection]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def seconds(self) -> float: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Detection: ...  # type: ignore[override]
    def __iter__(self) -> Iterator[Detection]: ...

class Recognizer:
    def __init__(
        self,
        models: Union[Path, Sequence[Model]],
        *,
        config: str = "default",
        set: Sequence[str] = (),
        model_unit: str = "",
        scene_unit: str = "",
        cache: str = "",
        threads: int = 0,
        seed: int = 0,
    ) -> None: ...
    def detect(
        self,
        points: Optional[npt.ArrayLike] = None,
        *,
        normals: Optional[npt.ArrayLike] = None,
        sensor: Optional[npt.ArrayLike] = None,
        depth: Optional[npt.NDArray[Any]] = None,
        K: Optional[npt.ArrayLike] = None,
        depth_scale: Optional[float] = None,
        file: Optional[Path] = None,
    ) -> Recognition: ...
    @property
    def models(self) -> list[str]: ...
