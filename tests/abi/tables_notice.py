#!/usr/bin/env python3
"""The check of the tables is awake: each planted change of the header draws a complaint.

tables_notice.py <ifsm.h>
"""
import sys
import tempfile
from pathlib import Path

from check_tables import check

CHANGES = {
    "a function more": ("IFSM_API int32_t ifsm_version(void);",
                        "IFSM_API int32_t ifsm_version(void);\nIFSM_API int32_t ifsm_new(void);"),
    "a function less": ("IFSM_API int32_t ifsm_version(void);", ""),
    "a constant with another number": ("IFSM_ERROR_BUSY = 13", "IFSM_ERROR_BUSY = 23"),
    "a constant more": ("IFSM_OK = 0,", "IFSM_OK = 0, IFSM_MORE = 99,"),
    "a field of another type": ("int32_t closed;", "int64_t closed;"),
    "a parameter of another type": ("ifsm_set_threads(int32_t threads)", "ifsm_set_threads(int64_t threads)"),
    "a parameter with another name": ("ifsm_set_threads(int32_t threads)", "ifsm_set_threads(int32_t count)"),
    "a type of no fixed width": ("ifsm_threads(int32_t *threads)", "ifsm_threads(int *threads)"),
    "a status that may be ignored": ("IFSM_API IFSM_MUST_USE ifsm_status ifsm_threads", "IFSM_API ifsm_status ifsm_threads"),
}

header = Path(sys.argv[1]).read_text(encoding="utf-8")
failed = check(sys.argv[1])
with tempfile.TemporaryDirectory() as folder:
    changed = Path(folder) / "ifsm.h"
    for what, (before, after) in CHANGES.items():
        if before not in header:
            failed.append(f"{what}: the header no longer says '{before}'; plant another change.")
            continue
        changed.write_text(header.replace(before, after, 1), encoding="utf-8")
        if not check(changed):
            failed.append(f"{what}: nobody noticed.")
print("\n".join(failed) or f"{len(CHANGES)} planted changes were noticed")
sys.exit(bool(failed))
