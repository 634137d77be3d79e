#!/usr/bin/env python3
"""What befalls long renders: killed processes, full disks, damaged films, parts in any order. Writes docs/long-renders.md.

    run.py    all of it, as ./build.sh faults does: goes on where it was interrupted

Each fault is tried on the programs themselves; what they leave is compared with what an undisturbed render leaves: pixels,
channels, and of the report all but times, threads and memory. Exit status 0 only where nothing was lost.
"""

import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bits import outputs, result

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "apps/bench"))
import reports  # noqa: E402

BIN = ROOT / "build/release/bin"
KILLS = 200
DAMAGES = 40
DISKS = (64, 500, 900, 1500, 3000)  # KiB: a film has 1000; while it is replaced there are two
SIZE = "112x112"
# Three figures, and what each is rendered to: a few seconds.
RENDERS = {
    "fig13_dielectric": ["--error", "2e-4"],
    "fig15_cornell_box": ["--spp", "150"],
    "fig18_with_dof": ["--error", "3e-4"],
}


def command(figure, *more):
    return [str(BIN / figure), "--size", SIZE, "--quiet", *RENDERS[figure], *more]


def run(words, folder, **more):
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL, **more)


def kills(figure, count, seed):
    """Kills at random moments until one render comes to its end, again and again, until there were so many."""
    draw = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        begin = time.monotonic()
        run(command(figure, "--threads", "2", *outputs("whole")), folder).check_returncode()
        seconds = time.monotonic() - begin
        whole = result(folder, "whole")
        killed = ended = different = lost = 0
        while killed < count:
            words = command(figure, "--threads", str(draw.choice((1, 2, 3))), "--checkpoint", "a.film", "--every", "0.05",
                            "--resume", "a.film", *outputs("resumed"))
            process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
            try:
                process.wait(draw.uniform(0, seconds))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                killed += 1
                continue
            finally:
                process.stderr.close()
            ended += 1
            lost += process.returncode != 0
            different += process.returncode == 0 and result(folder, "resumed") != whole
            left = {p.name for p in folder.iterdir()} - {"a.film", "whole.exr", "whole.json", "resumed.exr", "resumed.json"}
            lost += bool(left)
            (folder / "a.film").unlink(missing_ok=True)
    return {"tried": killed, "wrong": different + lost,
            "said": f"{killed} kills, {ended} renders to their end: {different} different, {lost} failed"}


def on_disk(size, action):
    """action(folder) with a disk of its own, of so many KiB, at folder; its process has its own mounts."""
    with tempfile.TemporaryDirectory() as name:
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "limn", name], check=True)
        try:
            return action(Path(name))
        finally:
            subprocess.run(["umount", name], check=True)


def full_disk(size):
    """The picture goes elsewhere; the film does not fit, or not twice: the render goes on and says so, and what film
    there is, is whole."""
    figure = "fig15_cornell_box"
    with tempfile.TemporaryDirectory() as name:
        pictures = Path(name)

        def action(disk):
            film = str(disk / "a.film")
            done = run(command(figure, "--checkpoint", film, "--every", "0.1", *outputs("a")), pictures)
            run(command(figure, *outputs("whole")), pictures).check_returncode()
            wrong = result(pictures, "a") != result(pictures, "whole")
            wrong += done.returncode != (0 if size > 2100 else 1)
            told = done.stderr.count("No space left on device")
            wrong += (told > 0) != (done.returncode != 0)
            wrong += (disk / "a.film").exists() != (size > 1100)
            if (disk / "a.film").exists():
                wrong += run([str(BIN / "limn"), "info", film], pictures).returncode != 0
            wrong += any(p.name.endswith(".tmp") for p in disk.iterdir())
            return {"tried": 1, "wrong": int(wrong > 0),
                    "said": f"{size} KiB: exit status {done.returncode}, told {told} times, "
                            f"film {'whole' if (disk / 'a.film').exists() else 'none'}, picture as ever"}

        return on_disk(size, action)


def read_only():
    """A folder that cannot be written is refused before anything is rendered; one that becomes so is told."""
    figure = "fig15_cornell_box"

    def action(disk):
        with tempfile.TemporaryDirectory() as name:
            pictures = Path(name)
            longer = [str(BIN / figure), "--size", SIZE, "--quiet", "--spp", "1500"]
            process = subprocess.Popen([*longer, "--checkpoint", str(disk / "a.film"), "--every", "0.3", *outputs("a")],
                                       cwd=pictures, stderr=subprocess.PIPE, text=True)
            while not (disk / "a.film").exists() and process.poll() is None:
                time.sleep(0.01)
            # Over itself, for a disk cannot be made read-only while a file there is open to be written.
            for way in ("bind", "remount,bind,ro"):
                subprocess.run(["mount", "-o", way, str(disk), str(disk)], check=True)
            said = process.communicate()[1]
            became = process.returncode == 1 and "Read-only file system" in said and (pictures / "a.exr").exists()
            refused = run(command(figure, "--checkpoint", str(disk / "b.film"), *outputs("b")), pictures)
            was = refused.returncode == 1 and "b.film" in refused.stderr and not (pictures / "b.exr").exists()
            subprocess.run(["umount", str(disk)], check=True)
            return {"tried": 2, "wrong": (not became) + (not was),
                    "said": f"refused at once: {'yes' if was else 'NO'}; told, and rendered on: {'yes' if became else 'NO'}"}

    return on_disk(8192, action)


def damages():
    """Films cut short and films with a flipped bit: refused by name, and left as they are."""
    draw = random.Random(3)
    figure = "fig15_cornell_box"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(command(figure, "--film", "a.film"), folder).check_returncode()
        film = (folder / "a.film").read_bytes()
        wrong, messages = 0, {}
        for i in range(2 * DAMAGES):
            if i < DAMAGES:
                damaged = film[:draw.randrange(len(film))]
            else:
                place = draw.randrange(len(film)) if i % 2 else draw.randrange(600)
                damaged = film[:place] + bytes([film[place] ^ 1 << draw.randrange(8)]) + film[place + 1:]
            (folder / "b.film").write_bytes(damaged)
            for words in (command(figure, "--resume", "b.film", "--checkpoint", "b.film", "-o", "b.exr"),
                          [str(BIN / "limn"), "merge", "b.film", "-o", "b.exr"]):
                done = run(words, folder)
                fault = re.search(r"b\.film: ([^:\d(;]*)", done.stderr)
                wrong += done.returncode != 1 or not fault or (folder / "b.exr").exists()
                if fault:
                    messages[fault[1].strip()] = messages.get(fault[1].strip(), 0) + 1
            wrong += (folder / "b.film").read_bytes() != damaged
    said = ", ".join(f"{count} \"{message}\"" for message, count in sorted(messages.items()))
    return {"tried": 4 * DAMAGES, "wrong": wrong, "said": f"each refused by --resume and by limn merge: {said}"}


def clock():
    """A clock that goes back a day between two parts of a render."""
    figure = "fig15_cornell_box"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(command(figure, *outputs("whole")), folder).check_returncode()
        process = subprocess.Popen(command(figure, "--checkpoint", "a.film", "--every", "0.05", *outputs("a")), cwd=folder)
        while not (folder / "a.film").exists():
            time.sleep(0.01)
        process.kill()
        process.wait()
        done = run(["faketime", "-f", "-1d", *command(figure, "--checkpoint", "a.film", "--every", "0.05", "--resume", "a.film",
                                                *outputs("a"))], folder)
        wrong = done.returncode != 0 or result(folder, "a") != result(folder, "whole")
    return {"tried": 1, "wrong": int(wrong), "said": "resumed a day before it began: " + ("DIFFERENT" if wrong else "the same")}


def two_renders():
    """Two renders on one checkpoint: the second is refused."""
    figure = "fig15_cornell_box"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        first = subprocess.Popen(command(figure, "-o", "a.exr", "--checkpoint", "a.film"), cwd=folder)
        while not (folder / "a.film.lock").exists() and first.poll() is None:
            time.sleep(0.01)
        second = run(command(figure, "-o", "b.exr", "--checkpoint", "a.film", "--resume", "a.film"), folder)
        ok = second.returncode == 1 and "is being written by another process" in second.stderr
        ok = first.wait() == 0 and ok and not (folder / "b.exr").exists()
    return {"tried": 1, "wrong": int(not ok), "said": "the second is refused" if ok else "the second is NOT refused"}


def orders():
    """Shards of figure 16 at its own size, merged in several orders: each picture is that of one run."""
    figure = [str(BIN / "fig16_volume_cornell_box"), "--quiet", "--spp", "16"]
    count = 7
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run([*figure, *outputs("whole")], folder).check_returncode()
        whole = result(folder, "whole")
        films = [f"{i}.film" for i in range(1, count + 1)]
        for i, film in enumerate(films, 1):
            run([*figure, "--shard", f"{i}/{count}", "--film", film], folder).check_returncode()
        tried = [films, films[::-1], random.Random(5).sample(films, count)]
        wrong = 0
        for order in tried:
            done = run([str(BIN / "limn"), "merge", *order, "--quiet", *outputs("merged")], folder)
            wrong += done.returncode != 0 or result(folder, "merged") != whole
    return {"tried": len(tried), "wrong": wrong, "said": "pixels, channels, estimate, samples and rays of one run: "
                                                         f"{len(tried) - wrong} of {len(tried)}"}


def main():
    head = reports.origin("faults")
    kept = reports.Kept(ROOT / "build/faults.json", sources=head["sources"])
    head = kept("head", lambda: head)
    figures = list(RENDERS)
    trials = [(f"kill -9, {figure}", lambda f=figure, i=i: kills(f, (KILLS - i + len(figures) - 1) // len(figures), i))
              for i, figure in enumerate(figures)]
    trials += [("full disk", lambda size=size: full_disk(size)) for size in DISKS]
    trials += [("read-only folder", read_only), ("films cut short, flipped bits", damages), ("clock set back", clock),
               ("two renders on one checkpoint", two_renders),
               ("7 shards of figure 16 merged in 3 orders", orders)]
    rows, wrong = [], 0
    for number, (name, trial) in enumerate(trials):
        row = kept(f"{number} {name}", trial, lambda row: not row["wrong"])
        wrong += row["wrong"]
        rows.append(f"| {name} | {row['tried']} | {row['wrong']} | {row['said']} |")
        print(f"faults: {rows[-1]}", flush=True)
    head["faults"] = wrong
    reports.write("faults", "\n".join([f"{reports.stamp(head)}, {kept.minutes():.0f} minutes.", "",
                                       "| fault | times | wrong | what happened |", "|---|---:|---:|---|", *rows]))
    if not wrong:
        kept.forget()
    return 1 if wrong else 0


if __name__ == "__main__":
    if shutil.which("faketime") is None:
        sys.exit("faults: faketime is missing (./build.sh faults installs it)")
    sys.exit(main())
