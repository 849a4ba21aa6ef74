#!/usr/bin/env python3
"""Prints suppressions for abidiff of structs that have only grown at their ends: grown_structs.py OLD.abi NEW.abi.

They may. abidiff's own word for it, `has_data_member_inserted_at = end`, hides fields that change places as well.
"""

import sys
import xml.etree.ElementTree as ElementTree


def layouts(file):
    """The fields of all structs, by their names: place, name, type."""
    root = ElementTree.parse(file).getroot()
    known = {element.get("id"): element for element in root.iter() if element.get("id")}

    def described(identifier):
        element = known[identifier]
        inner = element.get("type-id")
        if element.get("name") and element.tag != "array-type-def":
            return element.get("name")
        size = element.get("size-in-bits", "")
        return f"{element.tag} {size} {described(inner) if inner and element.tag != 'function-type' else ''}"

    found = {}
    for struct in root.iter("class-decl"):
        fields = []
        for member in struct.iter("data-member"):
            variable = member.find("var-decl")
            kind = described(variable.get("type-id"))
            fields.append((member.get("layout-offset-in-bits"), variable.get("name"), kind))
        if fields:
            found[struct.get("name")] = fields
    return found


def main():
    old, new = layouts(sys.argv[1]), layouts(sys.argv[2])
    if len(old) < 10:
        sys.exit(f"{sys.argv[1]} describes only {len(old)} structs")
    for name, fields in old.items():
        later = new.get(name, [])
        if len(later) > len(fields) and later[: len(fields)] == fields:
            # Behind the name of its Rust module.
            print(f"[suppress_type]\ntype_kind = struct\nname_regexp = (^|::){name}$\n")


main()
