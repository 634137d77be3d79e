"""Runs one of limn's peers: python worker.py NAME FILE_DESCRIPTOR.

A peer is a module NAME_peer with a class Peer. Peer has a text `about` with name, version and settings, a method
open(Scene), and the method render of a renderer (../renderers.py). The worker receives the description of a scene, and
then the arguments of one render after the other. It answers each with (True, result) or (False, message)."""

import importlib
import os
import sys
import traceback
from multiprocessing.connection import Connection

from geometry import Scene

pipe = Connection(int(sys.argv[2]))
try:
    peer = importlib.import_module(f"{sys.argv[1]}_peer").Peer()
    peer.open(Scene(pipe.recv()))
    pipe.send((True, peer.about))
    while True:
        pipe.send((True, peer.render(*pipe.recv())))
except EOFError:
    pass  # the other end of the pipe is closed
except Exception as problem:
    traceback.print_exc()
    pipe.send((False, f"{type(problem).__name__}: {problem}"))
sys.stderr.flush()
os._exit(0)  # skips the renderers' own cleanup, which is not reliable
