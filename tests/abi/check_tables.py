#!/usr/bin/env python3
"""Fails when include/ifsm.h and the tables of the ABI (functions.csv, structs.csv, constants.csv, symbols.txt) differ.

check_tables.py <ifsm.h>
"""
import csv
import re
import sys
from pathlib import Path

from header import Header

HERE = Path(__file__).parent
KINDS = {  # kind of a parameter -> what its type looks like
    "status": r"ifsm_status", "text": r"const char \*", "number": r"int32_t|uint64_t|ifsm_status",
    "handle": r"ifsm_\w+", "handle_out": r"ifsm_\w+ \*", "struct_in": r"const ifsm_\w+ \*",
    "structs_in": r"const ifsm_\w+ \*",
    "options_in": r"const ifsm_\w+_options \*", "options_out": r"ifsm_\w+_options \*", "struct_out": r"ifsm_\w+ \*",
    "size": r"uint32_t", "doubles_in": r"const double \*", "ints_in": r"const int32_t \*",
    "int64s_in": r"const int64_t \*", "bytes_in": r"const uint8_t \*", "uints_in": r"const uint32_t \*",
    "uints_out": r"uint32_t \*", "count": r"int64_t",
    "doubles_out": r"double \*", "ints_out": r"int32_t \*", "bytes_out": r"uint8_t \*", "capacity": r"int64_t",
    "count_out": r"int64_t \*", "double_out": r"double \*", "int_out": r"int32_t \*", "enum": r"int32_t",
    "integer": r"int32_t|int64_t", "zero": r"int32_t", "double": r"double", "string": r"const char \*", "name": r"const char \*",
    "callback": r"ifsm_\w+_callback", "user": r"void \*",
    "struct_size": r"uint32_t", "id": r"uint64_t", "told": r".*"}
OWNERSHIP = {"handle": {"borrowed", "destroyed"}, "handle_out": {"owned"}}
NULLABLE = {"handle", "handle_out", "struct_in", "options_in", "options_out", "struct_out", "doubles_in", "ints_in",
            "int64s_in", "bytes_in", "uints_in", "doubles_out", "ints_out", "uints_out", "bytes_out", "count_out", "double_out", "int_out", "string", "name",
            "callback", "user"}


def rows(name):
    with open(HERE / name, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def same(what, header, table, complaints):
    for name in header:
        if name not in table:
            complaints.append(f"{what} {name} is in ifsm.h and has no row in the table: add one.")
        elif header[name] != table[name]:
            complaints.append(f"{what} {name} is {header[name]} in ifsm.h and {table[name]} in the table.")
    for name in table:
        if name not in header:
            complaints.append(f"{what} {name} is in the table and not in ifsm.h.")
    if not complaints and list(header) != list(table):
        complaints.append(f"the {what}s stand in another order in the table than in ifsm.h.")


def check(header_path):
    header = Header(header_path)
    complaints = []
    if header.exports_in_text != len(header.functions):
        complaints.append(f"{header.exports_in_text} declarations start with IFSM_API and {len(header.functions)} were "
                          "read: teach header.py the others.")

    table = {}
    for row in rows("functions.csv"):
        where = f"{row['function']}, {row['parameter'] or 'result'}"
        if row["parameter"] == "":
            table[row["function"]] = (row["type"], row["kind"] == "status", [])
        else:
            table[row["function"]][2].append((row["parameter"], row["type"]))
        if not re.fullmatch(KINDS.get(row["kind"], "no such kind"), row["type"]):
            complaints.append(f"{where}: kind {row['kind']} does not go with type {row['type']}.")
        if row["parameter"] and row["ownership"] not in OWNERSHIP.get(row["kind"], {row["ownership"]}):
            complaints.append(f"{where}: ownership of a {row['kind']} cannot be '{row['ownership']}'.")
        if row["parameter"] and (row["kind"] in NULLABLE) != (row["null"] in {"refused", "allowed", "counts"}):
            complaints.append(f"{where}: the column null says '{row['null']}'.")
        ranged = row["parameter"] and row["kind"] in {"enum", "integer", "double"}
        if ranged and "" in (row["low"], row["high"], row["good"]):
            complaints.append(f"{where}: give its range and a good value.")
    same("function", header.functions, table, complaints)

    structs, directions = {}, {}
    for row in rows("structs.csv"):
        structs.setdefault(row["struct"], []).append((row["field"], row["type"]))
        directions[row["struct"]] = row["direction"]
        if not re.fullmatch(KINDS.get(row["kind"], "no such kind"), row["type"]):
            complaints.append(f"{row['struct']}.{row['field']}: kind {row['kind']} does not go with its type.")
    same("struct", header.structs, structs, complaints)
    for name, direction in directions.items():
        if (direction == "handle") != (name in header.handles):
            complaints.append(f"struct {name}: is it a handle?")

    same("constant", header.constants, {row["name"]: int(row["value"]) for row in rows("constants.csv")}, complaints)

    symbols = (HERE / "symbols.txt").read_text(encoding="utf-8").split()
    if symbols != sorted(header.functions):
        complaints.append("symbols.txt is not the sorted list of the functions of ifsm.h: "
                          f"{sorted(set(symbols) ^ set(header.functions))}")

    # What a C header that lasts does not say.
    bare = Path(header_path).read_text(encoding="utf-8")
    for word in ("Eigen", "ceres", "Ceres::", "tbb", "nlohmann", "hwy", "std::", "throw", "exception", "_Bool",
                 "stdbool", "long long", "size_t", "..."):
        code = re.sub(r"/\*.*?\*/", " ", bare, flags=re.S)
        if word in code:
            complaints.append(f"ifsm.h says '{word}' outside its comments.")
    for name, value in header.functions.items():
        for parameter, kind in value[2]:
            if re.search(r"\b(int|long|short|unsigned|bool|float|enum)\b", kind):
                complaints.append(f"{name}, {parameter}: {kind} is not of a fixed width.")
        if value[0] == "ifsm_status" and not value[1]:
            complaints.append(f"{name} lacks IFSM_MUST_USE.")
    return complaints


if __name__ == "__main__":
    found = check(sys.argv[1])
    print("\n".join(found) or "ifsm.h and the tables agree")
    sys.exit(bool(found))
