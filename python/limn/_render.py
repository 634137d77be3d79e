"""Renders pictures of compiled scenes."""

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
    """A rendered picture, its cost and its estimated error.

    image: the picture: shape (height, width, 3), float32, linear BT.709, not clamped, rows from the top. With `crop`
        the height and width are those of the crop window.
    report: a dict with the settings of the render and its cost: "scene" (the name), "width", "height", "seed",
        "threads", "max_depth", "samples_per_pixel" (the mean), "compile_seconds", "render_seconds", "rays",
        "nonfinite_samples" (they count as black), "unusable_rays" (they carry no light), "features", "memory_bytes",
        "complete", and "stopped_by": "samples", "error", "time" or "callback".
    error: a dict with the estimated relMSE of the picture as "estimate", and its 95 % interval as "ci95_low" and
        "ci95_high". If there is no estimate, the three numbers are NaN and "reason" says why. "max_sample_share" is the
        99.9th percentile over pixels of the largest share that one sample has of its pixel, 0 to 1. "reached" is True
        if "ci95_high" is at or under the `error` that was asked for.
    maps: a dict with an array of shape (height, width), float32, or None for each name. "error" is the estimated relMSE
        of each pixel, or None if there is no estimate. "samples" is the number of samples of each pixel. "alpha" is the
        part of each pixel that is not background, 0 to 1, or None without `transparent`. The colours of a transparent
        picture are multiplied by alpha.
    """

    image: npt.NDArray[np.float32]
    report: dict[str, Any]
    error: dict[str, Any]
    maps: dict[str, npt.NDArray[np.float32] | None]


@dataclass(frozen=True)
class FirstHits:
    """The first surface that the camera sees in each pixel.

    Media and the holes of an AlphaMask do not count as surfaces. Albedo and normal are means over 16 camera rays of the
    pixel. The other arrays have the values of the ray through the middle of the pixel.

    albedo: shape (height, width, 3), float32, 0 to 1; 0 if the rays hit nothing.
    normal: the shading normal on the camera's side: shape (height, width, 3), float32; 0 if the rays hit nothing.
    position: the hit point in world units: shape (height, width, 3), float32; 0 if the ray hits nothing.
    depth: the distance from the ray's origin in world units: shape (height, width), float32; infinite if the ray hits
        nothing.
    object: the number of the object, as Scene.add returned it: shape (height, width), int64; -1 if the ray hits
        nothing.
    primitive: the number of the primitive within the object: shape (height, width), int64; -1 if the ray hits nothing.
    """

    albedo: npt.NDArray[np.float32]
    normal: npt.NDArray[np.float32]
    position: npt.NDArray[np.float32]
    depth: npt.NDArray[np.float32]
    object: npt.NDArray[np.int64]
    primitive: npt.NDArray[np.int64]


def _compiled(scene: Scene | CompiledScene, camera: Camera) -> CompiledScene:
    """Returns the compiled scene. Raises a TypeError if the scene or the camera has a wrong type."""
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
    """Returns the first surface that the camera sees in each pixel, for compositing and denoising.

    The arguments are those of `render`. The function traces 17 camera rays for each pixel. It releases the GIL while it
    traces. Ctrl-C takes effect only when it has finished.
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
    """Renders a picture, and returns it with its cost and its estimated error.

    The arguments are those of `render`.
    """
    return RenderResult(*_limn._render(_compiled(scene, camera), camera, width, height, samples_per_pixel, max_depth,
                                       seed, threads, error, time_limit, max_samples_per_pixel, uniform, antialias,
                                       estimator, sampler, crop, transparent, progress))


def render(scene: Scene | CompiledScene, camera: Camera, **settings: Any) -> npt.NDArray[np.float32]:
    """Renders a picture and returns its array.

    The array has shape (height, width, 3) and type float32. Its values are linear BT.709 and not clamped. Its rows go
    from the top down. The function releases the GIL while it renders. Ctrl-C ends it with a KeyboardInterrupt.

    Args:
        scene: a CompiledScene, or a Scene, which is compiled first.
        camera: the Camera.
        width, height: size of the picture in pixels, 1 to 1048576, by default 400 each.
        samples_per_pixel: number of samples of each pixel, at least 1, by default 64. `error` and `time_limit` replace
            it.
        max_depth: largest number of ray segments of a path, at least 1, by default 10. None sets no limit.
        seed: an integer of at least 0. Another seed gives independent noise.
        threads: number of threads, up to 1024. 0, the default, uses all threads of the machine. The picture does not
            depend on it.
        error: the largest relMSE wanted. The render ends when the upper end of the 95 % interval of its estimated
            relMSE is at or under this number.
        time_limit: seconds after which the render ends, with the samples taken so far. Each pixel gets at least its
            first 8 samples.
        max_samples_per_pixel: the mean number of samples of a pixel at which the render ends in any case. It is used
            only with `error` or `time_limit`.
        uniform: True gives each pixel the same number of samples. False gives more samples to noisy parts of the
            picture. It is used only with `error` or `time_limit`.
        antialias: True spreads the samples over the pixel. False sends all of them through the pixel's centre.
        estimator: "path" (light sampling and scattering, by multiple importance sampling) or "naive" (scattering
            alone).
        sampler: "sobol" or "independent".
        crop: the window to render, as (left, top, right, bottom) in pixels from the top left corner. right and bottom
            are not included. The returned array has the pixels of the window alone. With the same number of samples
            they equal the pixels of the whole picture, bit for bit. None, the default, renders the whole picture.
        transparent: True leaves the background out of the picture, but not out of the light. The alpha is in the
            result of `render_with_report`.
        progress: a function that is called in the calling thread with a Progress, at most every 50 ms. If it returns
            False, the render ends with the samples taken so far. Other return values are ignored.
    """
    return render_with_report(scene, camera, **settings).image

