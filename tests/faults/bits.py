"""What two runs of one render must share."""

import json

import numpy
import OpenImageIO

CHANGING = ("seconds", "threads", "mrays_per_second", "memory_bytes")  # of a report


def outputs(name):
    """The options that write what `result` reads."""
    return ["-o", f"{name}.exr", "--report", f"{name}.json", "--channels", "error,samples"]


def pixels(path):
    """All channels of a picture, in bytes."""
    image = OpenImageIO.ImageInput.open(str(path))
    values = numpy.asarray(image.read_image("float")).tobytes()
    image.close()
    return values


def result(folder, name):
    """Pixels, channels, and of the report all but times, threads and memory."""
    report = json.loads((folder / f"{name}.json").read_text())
    return pixels(folder / f"{name}.exr"), {k: v for k, v in report.items() if k not in CHANGING}
