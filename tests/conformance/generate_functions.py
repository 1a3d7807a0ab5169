#!/usr/bin/env python3
"""Writes the table of all functions that a language's binding has, each callable with arguments from JSON.

generate_functions.py <ifsm.h> <options.h> <output.cpp>

Parameters are those of ifsm.h, or of bindings/options.h for functions with options; what may be said of their values
comes from the tables of tests/abi.
"""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "abi"))
from check_tables import rows  # noqa: E402
from header import Header, declarations, split_name  # noqa: E402

HIDDEN = re.compile(r"ifsm_last_error|ifsm_set_interrupt|.*_destroy|.*_options_init")  # as in bindings/ifsm.i
RENAMED = {"kept_count": "count", "point_count": "points"}  # options.h gives fields other names where another parameter has theirs
IN_TABLE = {"reserved", "struct_size"}
ELEMENTS = {"double": "double", "int32_t": "int32", "int64_t": "int64", "uint32_t": "uint32", "uint8_t": "bytes"}


def flattened(path):
    """name -> parameters of the functions of options.h."""
    text = declarations(Path(path).read_text(encoding="utf-8"))
    return {name: [split_name(part) for part in inside.split(",")]
            for name, inside in re.findall(r"inline ifsm_status (\w+)\(([^()]*)\)", text)}


class Slots:
    """A function's parameters in JSON, made of one or several of C: (name, kind, [expressions])."""

    def __init__(self, header):
        self.header = header

    def read(self, parameters):
        slots = []
        while parameters:
            (name, kind), rest = parameters[0], parameters[1:]
            slot, taken = self.slot(name, kind.replace(" *", "*"), rest)
            slots.append((name, slot, [f"call.{expression}" for expression in taken]))
            parameters = parameters[len(taken):]
        return slots

    def slot(self, name, kind, rest):
        counted = bool(rest) and rest[0][1] == "int64_t" and rest[0][0].endswith("count")
        has_room = bool(rest) and rest[0] == ("capacity", "int64_t")
        target = kind.replace("const ", "").rstrip("*")
        said = f'"{name}"'
        if kind == "const char*":
            return "text", [f"text({said})"]
        if kind == "const ifsm_curve*":
            return ("curves", [f"curves({said})", f"curve_count({said})"]) if counted else ("curve", [f"curve({said})"])
        if kind.startswith("const ") and counted and target in ELEMENTS:
            return ELEMENTS[target] + "s", [f"array<{target}>({said})", f"count<{target}>({said})"]
        if has_room and target in ELEMENTS:
            return "output", [f"{what}<{target}>({said})" for what in ("output", "capacity", "told_count")]
        if kind.endswith("_callback"):
            return "callback", [f"callback<{kind}>({said})", "user()"]
        if kind == "KnownSamples":
            return "known", [f"known({said})"]
        if kind in self.header.handles:
            return "handle", [f"handle<{kind}>({said})"]
        if kind.endswith("*"):
            return ("made", [f"made<{target}>()"]) if target in self.header.handles else (
                "told", [f"told<{target}>({said})"])
        if kind == "double":
            return "real", [f"real({said})"]
        return {"int32_t": "int32", "ifsm_status": "int32"}.get(kind, kind.removesuffix("_t")), [
            f"integer<{kind}>({said})"]


def limits():
    """(function, parameter) -> (low, high, null) of the tables."""
    fields = {}
    for row in rows("structs.csv"):
        fields.setdefault(row["struct"], {})[row["field"]] = (row["low"], row["high"], row["null"])
    found = {}
    for row in rows("functions.csv"):
        found[row["function"], row["parameter"]] = (row["low"], row["high"], row["null"])
        if row["kind"] == "options_in":
            struct = row["type"].replace("const ", "").rstrip(" *")
            for field, said in fields[struct].items():
                found.setdefault((row["function"], field), said)
            for name, field in RENAMED.items():
                if field in fields[struct]:
                    found[row["function"], name] = fields[struct][field]
    return found


def main(header_path, options_path, output):
    header, options, said = Header(header_path), flattened(options_path), limits()
    slots = Slots(header)
    out = ["// Generated from ifsm.h, options.h and the tables of tests/abi by generate_functions.py.",
           '#include "functions.h"', "", '#include "call.h"', "", "namespace conformance {", ""]
    told = sorted({kind.rstrip(" *") for _, _, parameters in header.functions.values() for _, kind in parameters
                   if not kind.startswith("const") and kind.rstrip(" *") in header.structs
                   and kind.rstrip(" *") not in header.handles and not kind.rstrip(" *").endswith("_options")
                   and kind.rstrip(" *") != "ifsm_error"})
    for struct in told:
        out += ["template <>", f"Json json_of(const {struct}& told) {{", "  Json fields = Json::object();"]
        out += [f'  fields["{field}"] = json_of(told.{field});' for field, _ in header.structs[struct]
                if field not in IN_TABLE]
        out += ["  return fields;", "}", ""]
    out += ["const std::vector<Function>& functions() {", "  static const std::vector<Function> all = {"]
    for name, (returned, _, parameters) in header.functions.items():
        if HIDDEN.fullmatch(name):
            continue
        read = slots.read(options.get(name, parameters))
        scope = "ifsm_bindings::" if name in options else "::"
        called = f"{scope}{name}({', '.join(expression for _, _, taken in read for expression in taken)})"
        body = f"return {called};" if returned == "ifsm_status" else f'call.returns({called}); return IFSM_OK;'
        unused = "" if read or returned != "ifsm_status" else "static_cast<void>(call); "
        columns = [(parameter, kind, *said.get((name, parameter), ("", "", ""))) for parameter, kind, _ in read]
        table = ", ".join('{"%s", "%s", "%s", "%s", "%s"}' % row for row in columns)
        out.append(f'      {{"{name}", {{{table}}}, [](Call& call) -> ifsm_status {{ {unused}{body} }}}},')
    out += ["  };", "  return all;", "}", "", "}  // namespace conformance", ""]
    Path(output).write_text("\n".join(out), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
