"""Heaps of glibc: threads share as many as there are processors, and what is free goes back to the system."""

import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from heeltoe.base.heap import give_back

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="other systems have other heaps")

HEAPS = """
import ctypes, sys, threading
from heeltoe.base.heap import share_heaps

if sys.argv[1] == "shared":
    share_heaps()
library = ctypes.CDLL(None)
library.malloc.restype, library.fopen.restype = ctypes.c_void_p, ctypes.c_void_p
count = 4 * int(sys.argv[2])
together = threading.Barrier(count)

def work():
    together.wait()
    library.malloc(1000)
    together.wait()

threads = [threading.Thread(target=work) for _ in range(count)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
file = ctypes.c_void_p(library.fopen(sys.argv[3].encode(), b"w"))
library.malloc_info(0, file)
library.fclose(file)
"""
FREED = """
import ctypes
from pathlib import Path
from heeltoe.base.heap import give_back

def occupied():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

library = ctypes.CDLL(None)
library.malloc.restype = ctypes.c_void_p
blocks = [ctypes.c_void_p(library.malloc(65536)) for _ in range(1600)]
for block in blocks:
    ctypes.memset(block, 1, 65536)
# The last one keeps all below it in the heap.
for block in blocks[:-1]:
    library.free(block)
before = occupied()
give_back()
print(before - occupied())
"""


def output(program: str, *words: str) -> str:
    around = {name: value for name, value in os.environ.items() if name != "MALLOC_ARENA_MAX"}
    command = [sys.executable, "-c", program, *words]
    return subprocess.run(command, env=around, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("kind", ["shared", "apart"])
def test_threads_share_a_heap_for_each_processor(tmp_path, kind):
    processors, file = os.cpu_count(), tmp_path / "heaps.xml"
    output(HEAPS, kind, str(processors), str(file))
    heaps = file.read_text().count("<heap nr=")
    assert heaps <= processors if kind == "shared" else heaps > processors


def test_what_is_free_goes_back():
    # Nearly all of 100 MB.
    assert int(output(FREED)) > 80e6


def test_arrow_gives_its_heap_back_too(monkeypatch):
    released = []
    pool = SimpleNamespace(release_unused=lambda: released.append(True))
    monkeypatch.setitem(sys.modules, "pyarrow", SimpleNamespace(default_memory_pool=lambda: pool))
    give_back()
    assert released == [True]
