"""One of limn's peers, waiting for work: python worker.py mitsuba|cycles|luxcore.

Reads a JSON object a line from standard input and answers each with one on standard output:
    {"do": "open", "scene": FILE}                                            -> {"seconds": {"load": s}}
    {"do": "render", "size": N, "spp": N, "seed": N, "threads": N, "out": FILE.npy}
                                       -> {"seconds": {"render": s, "setup": s}, "spp": n}
The first line that it writes, unasked, says who it is. What fails is answered by {"error": message}. Pictures are
float32 arrays of height x width x 3, linear, rows from the top. "render" is the rendering alone; loading, building,
compiling kernels and writing files are "setup" or "load".
"""

import importlib
import json
import os
import sys
import time
import traceback

import numpy as np


def main():
    # Renderers print what they like: the real standard output is kept for the answers.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)

    def answer(message):
        answers.write(json.dumps(message) + "\n")
        answers.flush()

    start = time.perf_counter()
    try:
        peer = importlib.import_module(f"{sys.argv[1]}_peer").Peer()
    except Exception as problem:  # not installed, or does not start here: the report goes on without it
        answer({"error": f"{type(problem).__name__}: {problem}"})
        return
    answer({"name": peer.name, "version": peer.version, "settings": peer.settings,
            "seconds": {"start": time.perf_counter() - start}})
    from geometry import Scene
    for line in sys.stdin:
        request = json.loads(line)
        start = time.perf_counter()
        try:
            if request["do"] == "open":
                peer.open(Scene(request["scene"]))
                answer({"seconds": {"load": time.perf_counter() - start}})
                continue
            pixels, seconds, spp = peer.render(request["size"], request["spp"], request["seed"], request["threads"])
            whole = time.perf_counter() - start
            np.save(request["out"], np.ascontiguousarray(pixels, dtype=np.float32))
            answer({"seconds": {"render": seconds, "setup": max(0, whole - seconds)}, "spp": spp})
        except Exception as problem:
            traceback.print_exc()
            answer({"error": f"{type(problem).__name__}: {problem}"})


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # what the renderers do at their ends is not always clean
