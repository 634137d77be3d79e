"""What befalls long renders: killed processes, full disks, damaged films, a clock that goes back.

Each fault is tried on the programs themselves. What they leave is compared with what an undisturbed render leaves:
pixels, channels, and all of the report but times, threads and memory.
"""

import json
import random
import subprocess
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import numpy
import OpenImageIO

from results import BIN

KILLS = 200
DAMAGES = 40
DISKS = (64, 500, 900, 1500, 3000)  # KiB: a film has 1000, and while it is replaced there are two
CHANGING = ("seconds", "threads", "mrays_per_second", "memory_bytes")  # of a report
BOX = "fig15_cornell_box"
RENDERS = {"fig13_dielectric": ["--error", "2e-4"], BOX: ["--spp", "150"], "fig18_with_dof": ["--error", "3e-4"]}


def command(figure, *more):
    """A render of a few seconds."""
    return [BIN / figure, "--size", "112x112", "--quiet", *RENDERS[figure], *more]


def outputs(name):
    """The options that write what `result` reads."""
    return ["-o", f"{name}.exr", "--report", f"{name}.json", "--channels", "error,samples"]


def run(words, folder):
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL)


def pixels(path):
    """All channels of a picture, in bytes."""
    image = OpenImageIO.ImageInput.open(str(path))
    values = numpy.asarray(image.read_image("float")).tobytes()
    image.close()
    return values


def result(folder, name):
    report = json.loads((folder / f"{name}.json").read_text())
    return pixels(folder / f"{name}.exr"), {k: v for k, v in report.items() if k not in CHANGING}


@contextmanager
def beside_whole(figure):
    """A folder with the undisturbed render, and its result."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(command(figure, *outputs("whole")), folder).check_returncode()
        yield folder, result(folder, "whole")


@contextmanager
def disk(kibibytes):
    with tempfile.TemporaryDirectory() as name:
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "limn", name], check=True)
        try:
            yield Path(name)
        finally:
            subprocess.run(["umount", name], check=True)


def kills(figure, count, seed):
    """Kills a render at random moments until it comes to its end, again and again."""
    draw, killed, ended, lost = random.Random(seed), 0, 0, 0
    with beside_whole(figure) as (folder, whole):
        seconds = json.loads((folder / "whole.json").read_text())["seconds"]["render"]
        while killed < count:
            process = subprocess.Popen(
                command(figure, "--threads", draw.choice("123"), "--checkpoint", "a.film", "--every", "0.05",
                        "--resume", "a.film", *outputs("resumed")),
                cwd=folder, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(draw.uniform(0, 1.5 * seconds))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                killed += 1
                continue
            ended += 1
            left = {p.name for p in folder.iterdir()}
            fine = left == {"a.film", "whole.exr", "whole.json", "resumed.exr", "resumed.json"}
            lost += process.returncode != 0 or not fine or result(folder, "resumed") != whole
            (folder / "a.film").unlink(missing_ok=True)
    return killed, lost, f"{ended} renders came to their end"


def full_disk(kibibytes):
    """The film does not fit, or not twice: the render goes on and says so, and what film there is, is whole."""
    with beside_whole(BOX) as (folder, whole), disk(kibibytes) as other:
        film = other / "a.film"
        done = run(command(BOX, "--checkpoint", film, "--every", "0.1", *outputs("a")), folder)
        told = "No space left on device" in done.stderr
        fine = (result(folder, "a") == whole and done.returncode == (0 if kibibytes > 2100 else 1)
                and told == (done.returncode != 0) and film.exists() == (kibibytes > 1100)
                and not any(p.name.endswith(".tmp") for p in other.iterdir())
                and (not film.exists() or run([BIN / "limn", "info", film], folder).returncode == 0))
        return 1, int(not fine), f"exit status {done.returncode}, film {'whole' if film.exists() else 'none'}"


def damages():
    """Films cut short and films with a flipped bit are refused by name, and left as they are."""
    draw, wrong = random.Random(3), 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(command(BOX, "--film", "a.film"), folder).check_returncode()
        film = (folder / "a.film").read_bytes()
        for i in range(2 * DAMAGES):
            place = draw.randrange(600 if i % 2 else len(film))
            flipped = bytes([film[place] ^ 1 << draw.randrange(8)])
            damaged = film[:place] if i < DAMAGES else film[:place] + flipped + film[place + 1:]
            (folder / "b.film").write_bytes(damaged)
            for words in (command(BOX, "--resume", "b.film", "--checkpoint", "b.film", "-o", "b.exr"),
                          [BIN / "limn", "merge", "b.film", "-o", "b.exr"]):
                done = run(words, folder)
                wrong += done.returncode != 1 or "b.film: is " not in done.stderr or (folder / "b.exr").exists()
            wrong += (folder / "b.film").read_bytes() != damaged
    return 4 * DAMAGES, wrong, "refused by --resume and by limn merge"


def clock():
    """A clock goes back a day between two parts of a render."""
    with beside_whole(BOX) as (folder, whole):
        words = command(BOX, "--checkpoint", "a.film", "--every", "0.05", "--resume", "a.film", *outputs("a"))
        process = subprocess.Popen(words, cwd=folder)
        while not (folder / "a.film").exists() and process.poll() is None:
            time.sleep(0.01)
        process.kill()
        process.wait()
        done = run(["faketime", "-f", "-1d", *words], folder)
        return 1, int(done.returncode != 0 or result(folder, "a") != whole), "resumed a day before it began"


def measure():
    """Yields for each fault its name, how often it was tried, how often it went wrong, and what happened."""
    for i, figure in enumerate(RENDERS):
        yield [f"kill -9, {figure}", *kills(figure, -(-(KILLS - i) // len(RENDERS)), i)]
    for size in DISKS:
        yield [f"a disk of {size} KiB", *full_disk(size)]
    yield ["films cut short, flipped bits", *damages()]
    yield ["a clock set back by a day", *clock()]
