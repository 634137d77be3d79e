"""One of limn's peers: python worker.py NAME FILE_DESCRIPTOR.

Reads requests from a multiprocessing.Connection and answers with (True, result) or (False, message), until the other end
is closed. A peer is a module NAME_peer with a class Peer, which has an `about` (name, version and settings), open(Scene),
and render(size, spp, seed, threads). That returns the picture as an array of height x width x 3, linear, rows from the
top; the seconds of rendering alone; and the samples a pixel that the picture has.
"""

import importlib
import os
import sys
import traceback
from multiprocessing.connection import Connection

import numpy as np

from geometry import Scene


def main(name, pipe):
    peer = importlib.import_module(f"{name}_peer").Peer()

    def open(description):
        peer.open(Scene(description))
        return peer.about

    def render(*arguments):
        picture, seconds, spp = peer.render(*arguments)
        return np.ascontiguousarray(picture, dtype=np.float64).tobytes(), seconds, spp

    while True:
        what, *arguments = pipe.recv()
        pipe.send((True, {"open": open, "render": render}[what](*arguments)))


if __name__ == "__main__":
    pipe, status = Connection(int(sys.argv[2])), 0
    try:
        main(sys.argv[1], pipe)
    except EOFError:
        pass  # the other end is closed
    except Exception as problem:
        traceback.print_exc()
        pipe.send((False, f"{type(problem).__name__}: {problem}"))
    sys.stderr.flush()
    os._exit(0)  # what the renderers do at their ends is not always clean
