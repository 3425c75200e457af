"""Runs a program where no further Landlock domain can be built: the kernel allows 16, each within the last.

Usage: landlock.py PROGRAM ARGUMENTS...   exit code 77: this kernel has no Landlock
"""
import ctypes
import os
import struct
import sys

CREATE, RESTRICT, VERSION, DOMAINS = 444, 446, 1, 16
MAKE_BLOCK_DEVICE = 1 << 11  # a right that nothing here uses
NO_NEW_PRIVS = 38

libc = ctypes.CDLL(None, use_errno=True)
if libc.syscall(CREATE, None, 0, VERSION) < 1:
    sys.exit(77)
libc.prctl(NO_NEW_PRIVS, 1, 0, 0, 0)
for _ in range(DOMAINS):
    rules = libc.syscall(CREATE, struct.pack("Q", MAKE_BLOCK_DEVICE), 8, 0)
    if rules < 0 or libc.syscall(RESTRICT, rules, 0) != 0:
        sys.exit(os.strerror(ctypes.get_errno()))
    os.close(rules)
os.execv(sys.argv[1], sys.argv[1:])
