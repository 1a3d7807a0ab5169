#!/usr/bin/env python3
"""Writes the calls of the misuse matrix: every function of functions.csv, callable with any arguments.

generate_calls.py <output.cpp>
"""
import sys

from check_tables import rows

SIZES = {"doubles_out": "sizeof(double)", "ints_out": "sizeof(std::int32_t)", "uints_out": "sizeof(std::uint32_t)", "bytes_out": "1"}


def quoted(text):
    return f'"{text}"'


def parameter(row, struct):
    target = row["type"].replace("const ", "").replace("*", "").strip()
    size = SIZES.get(row["kind"], "0" if target in ("void", "char") else f"sizeof({target})")
    texts = [row["parameter"], target, row["kind"], row["ownership"], row["null"], row["low"], row["high"], row["good"]]
    return "{" + ", ".join(map(quoted, texts)) + f", {size}" + "}"


def main(path):
    functions = {}
    for row in rows("functions.csv"):
        functions.setdefault(row["function"], []).append(row)
    fields = {}
    for row in rows("structs.csv"):
        if row["direction"] == "in" and row["kind"] != "struct_size":
            fields.setdefault(row["struct"], []).append(row)

    out = ['// Generated from functions.csv and structs.csv by generate_calls.py.', '#include "calls.h"', "",
           "#include <cstddef>", "", "namespace misuse {", "", "const std::vector<Function>& functions() {",
           "  static const std::vector<Function> all = {"]
    for name, (result, *parameters) in functions.items():
        arguments = ", ".join(f"as<{row['type']}>(a[{i}])" for i, row in enumerate(parameters))
        call = f"{name}({arguments})"
        body = f"return {call};" if result["kind"] == "status" else f"static_cast<void>({call}); return IFSM_OK;"
        unused = "" if parameters else "static_cast<void>(a); "
        out.append(f'      {{"{name}", {"true" if result["kind"] == "status" else "false"},')
        out.append("       {" + (",\n        ".join(parameter(row, None) for row in parameters)) + "},")
        out.append(f"       [](const Arguments& a) -> ifsm_status {{ {unused}{body} }}}},")
    out += ["  };", "  return all;", "}", "", "const std::vector<Field>& fields(const std::string& type) {",
            "  static const std::map<std::string, std::vector<Field>> all = {"]
    for name, members in fields.items():
        out.append(f'      {{"{name}", {{')
        for row in members:
            texts = ", ".join(map(quoted, (row["field"], row["type"], row["kind"], row["low"], row["high"])))
            out.append(f"           {{{texts}, offsetof({name}, {row['field']}), sizeof({name}::{row['field']})}},")
        out.append("       }},")
    out += ["  };", "  return all.at(type);", "}", "", "}  // namespace misuse", ""]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(out))


if __name__ == "__main__":
    main(sys.argv[1])
