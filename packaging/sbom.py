#!/usr/bin/env python3
"""Prints what a library or program is made of, as CycloneDX 1.6 has it (cyclonedx.org): sbom.py fairmesh-capi|fairmesh-cli TRIPLE

The bytes depend on Cargo.lock alone; the checksums are those of crates.io.
"""

import json
import sys
import tomllib
from uuid import NAMESPACE_URL, uuid5

from linked_crates import ROOT, linked


def checksums():
    """Of each crate in Cargo.lock."""
    with (ROOT / "Cargo.lock").open("rb") as file:
        locked = tomllib.load(file)["package"]
    return {(package["name"], package["version"]): package.get("checksum") for package in locked}


def component(package, kind):
    """A crate."""
    told = {
        "type": kind,
        "bom-ref": f"pkg:cargo/{package['name']}@{package['version']}",
        "name": package["name"],
        "version": package["version"],
        "purl": f"pkg:cargo/{package['name']}@{package['version']}",
        # Older manifests have a slash where the list of licences has OR.
        "licenses": [{"expression": package["license"].replace("/", " OR ")}],
    }
    if package["repository"]:
        told["externalReferences"] = [{"type": "vcs", "url": package["repository"]}]
    return told


def main():
    crate, platform = sys.argv[1:]
    own, others = linked(crate, platform)
    known = checksums()
    components = []
    for package in others:
        told = component(package, "library")
        told["hashes"] = [{"alg": "SHA-256", "content": known[package["name"], package["version"]]}]
        components.append(told)
    subject = component(own, "library" if crate == "fairmesh-capi" else "application")
    subject["properties"] = [{"name": "target", "value": platform}]
    bom = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "serialNumber": uuid5(NAMESPACE_URL, json.dumps([platform, subject, components])).urn,
        "version": 1,
        "metadata": {"component": subject},
        "components": components,
        "dependencies": [{"ref": subject["bom-ref"], "dependsOn": [each["bom-ref"] for each in components]}],
    }
    print(json.dumps(bom, indent=2))


main()
