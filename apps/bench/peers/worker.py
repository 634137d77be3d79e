"""One of limn's peers: python worker.py NAME FILE_DESCRIPTOR.

A peer is a module NAME_peer with a class Peer, which has an `about` (name, version and settings), open(Scene), and
render(picture, size, spp, seed, threads). That writes an EXR file, and returns the seconds of rendering alone and the
samples a pixel. A worker receives a description of a scene and then the arguments of renders. It answers with (True,
result) or (False, message)."""

import importlib
import os
import sys
import traceback
from multiprocessing.connection import Connection

from geometry import Scene


if __name__ == "__main__":
    pipe = Connection(int(sys.argv[2]))
    try:
        peer = importlib.import_module(f"{sys.argv[1]}_peer").Peer()
        peer.open(Scene(pipe.recv()))
        pipe.send((True, peer.about))
        while True:
            pipe.send((True, peer.render(*pipe.recv())))
    except EOFError:
        pass  # the other end is closed
    except Exception as problem:
        traceback.print_exc()
        pipe.send((False, f"{type(problem).__name__}: {problem}"))
    sys.stderr.flush()
    os._exit(0)  # what the renderers do at their ends is not always clean
