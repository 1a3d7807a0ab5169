"""What include/ifsm.h declares, read from its text: functions, structs, constants, callbacks."""
import re
from pathlib import Path


def declarations(text):
    """The header without comments, preprocessor lines and white space that says nothing."""
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r"//[^\n]*", " ", text)
    text = re.sub(r"^#[^\n]*", " ", text, flags=re.M)
    return re.sub(r"\s+", " ", text)


def split_name(declaration):
    """'const double *points' -> ('points', 'const double *')."""
    kind, name = re.fullmatch(r"(.*?)(\w+)", declaration.strip()).groups()
    return name, kind.strip()


class Header:
    def __init__(self, path):
        text = declarations(Path(path).read_text(encoding="utf-8"))
        self.functions = {}  # name -> (return type, must use, [(parameter, type)])
        for must_use, returned, name, inside in re.findall(
                r"IFSM_API (IFSM_MUST_USE )?([\w ]+?[ *]+)(\w+)\(([^()]*)\);", text):
            parameters = [] if inside.strip() == "void" else [split_name(part) for part in inside.split(",")]
            self.functions[name] = (returned.strip(), bool(must_use), parameters)
        self.structs = {  # name -> [(field, type)]
            name: [split_name(field) for field in inside.split(";") if field.strip()]
            for inside, name in re.findall(r"typedef struct \w+ \{([^}]*)\} (\w+);", text)}
        self.handles = [name for name, fields in self.structs.items() if fields == [("id", "uint64_t")]]
        self.constants = {}
        for inside in re.findall(r"\benum \{([^}]*)\}", text):
            for constant in filter(None, map(str.strip, inside.split(","))):
                name, value = re.fullmatch(r"(\w+) = (-?\w+)", constant).groups()  # every value is written out
                self.constants[name] = int(value, 0)
        self.callbacks = {name: f"{returned}({inside})" for returned, name, inside in re.findall(
            r"typedef (\w+) \(\*(\w+)\)\(([^()]*)\);", text)}
        self.exports_in_text = len(re.findall(r"\bIFSM_API\b", text))
