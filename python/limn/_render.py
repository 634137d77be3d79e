"""Pictures from compiled scenes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _limn
from ._limn import Camera, CompiledScene, Progress, Scene

MOST_SAMPLES = 1 << 20


@dataclass(frozen=True)
class RenderResult:
    """A picture and what is known of it.

    image: shape (height, width, 3), float32, linear BT.709, not clamped, rows from the top.
    report: what was rendered, how, and what it cost.
    error: the estimated relMSE: "estimate", "ci95_low", "ci95_high"; NaN, with a "reason", where there is none.
    maps: "error", "samples" and "alpha" of each pixel, shape (height, width), float32; None where there is none. With
        transparent, alpha is how much of the pixel is not background, 0 to 1, and colours are multiplied by it.
    """

    image: npt.NDArray[np.float32]
    report: dict[str, Any]
    error: dict[str, Any]
    maps: dict[str, npt.NDArray[np.float32] | None]


@dataclass(frozen=True)
class FirstHits:
    """Of each pixel the first surface that the camera sees; media and the holes of an AlphaMask are looked through.

    Albedo and normal are means over 16 camera rays of the pixel; all else is that of the ray through its middle.

    albedo: shape (height, width, 3), float32, 0 to 1; 0 where there is nothing.
    normal: shape (height, width, 3), float32, the shading normal on the camera's side; 0 where there is nothing.
    position: shape (height, width, 3), float32, in world units; 0 where there is nothing.
    depth: shape (height, width), float32, from the ray's origin in world units; infinite where there is nothing.
    object: shape (height, width), int64, what Scene.add returned; -1 where there is nothing.
    primitive: shape (height, width), int64, the primitive in the object; -1 where there is nothing.
    """

    albedo: npt.NDArray[np.float32]
    normal: npt.NDArray[np.float32]
    position: npt.NDArray[np.float32]
    depth: npt.NDArray[np.float32]
    object: npt.NDArray[np.int64]
    primitive: npt.NDArray[np.int64]


def _compiled(scene: Scene | CompiledScene, camera: Camera) -> CompiledScene:
    """What is to be seen, both arguments checked."""
    if isinstance(scene, Scene):
        scene = scene.compile()
    if not isinstance(scene, CompiledScene):
        raise TypeError(f"scene: must be a Scene or a CompiledScene, not {type(scene).__name__}")
    if not isinstance(camera, Camera):
        raise TypeError(f"camera: must be a Camera, not {type(camera).__name__}")
    return scene


def first_hits(scene: Scene | CompiledScene, camera: Camera, *, width: int = 400, height: int = 400, seed: int = 0,
               threads: int = 0, antialias: bool = True, sampler: str = "sobol",
               crop: Sequence[int] | None = None) -> FirstHits:
    """What the camera meets first, for compositing and denoising. Arguments as those of `render`.

    Takes 17 rays a pixel. The interpreter's lock is let go meanwhile; Ctrl-C is seen at the end.
    """
    return FirstHits(*_limn._first_hits(_compiled(scene, camera), camera, width, height, seed, threads, antialias,
                                        sampler, crop))


def render_with_report(scene: Scene | CompiledScene, camera: Camera, *, width: int = 400, height: int = 400,
                       samples_per_pixel: int = 64, max_depth: int | None = 10, seed: int = 0, threads: int = 0,
                       error: float | None = None, time_limit: float | None = None,
                       max_samples_per_pixel: int = MOST_SAMPLES, uniform: bool = False, antialias: bool = True,
                       estimator: str = "path", sampler: str = "sobol", crop: Sequence[int] | None = None,
                       transparent: bool = False,
                       progress: Callable[[Progress], bool | None] | None = None) -> RenderResult:
    """Renders a picture, and says what it cost and how large its error is. Arguments as those of `render`."""
    return RenderResult(*_limn._render(_compiled(scene, camera), camera, width, height, samples_per_pixel, max_depth, seed,
                                       threads, error, time_limit, max_samples_per_pixel, uniform, antialias, estimator,
                                       sampler, crop, transparent, progress))


def render(scene: Scene | CompiledScene, camera: Camera, **settings: Any) -> npt.NDArray[np.float32]:
    """Renders a picture: shape (height, width, 3), float32, linear BT.709, not clamped, rows from the top.

    The interpreter's lock is let go meanwhile. Ctrl-C ends the render with a KeyboardInterrupt.

    Args:
        scene: compiled, or to be compiled.
        camera: what takes the picture.
        width, height: in pixels, 400 each by default.
        samples_per_pixel: at least 1, by default 64.
        max_depth: ray segments of a path, by default 10; None: no limit.
        seed: another one gives independent noise.
        threads: 0: all. The picture does not depend on it.
        error: the relMSE to render to; then there are as many samples as that takes.
        time_limit: in seconds, after which the render ends with what there is.
        max_samples_per_pixel: with error or time_limit, the mean at which the render ends in any case.
        uniform: with error or time_limit, as many samples for each pixel.
        antialias: False: every sample goes through the pixel's centre.
        estimator: "path" or "naive". sampler: "sobol" or "independent".
        crop: left, top, right, bottom in pixels from the top left, the last two not included: the array has these
            alone, and they are those of the whole picture, bit for bit, with as many samples. None: all.
        transparent: leaves the background out of what the camera sees, but not out of the light;
            `render_with_report` has the alpha.
        progress: called in the calling thread with a Progress, at most every 50 ms; what it returns is ignored unless
            it is False, which ends the render with what there is.
    """
    return render_with_report(scene, camera, **settings).image

