"""A GLB file read by hand."""

import json
import struct

import numpy as np

WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
TYPES = {5126: "<f4", 5125: "<u4"}


def read(data):
    """The document and the values of every accessor."""
    magic, version, size = struct.unpack_from("<4sII", data)
    assert (magic, version, size) == (b"glTF", 2, len(data))
    length, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    assert length % 4 == 0
    document = json.loads(data[20 : 20 + length])
    rest, kind = struct.unpack_from("<I4s", data, 20 + length)
    assert kind == b"BIN\0"
    assert rest % 4 == 0
    binary = data[28 + length :]
    assert len(binary) == rest >= document["buffers"][0]["byteLength"]
    values = []
    for item in document["accessors"]:
        view = document["bufferViews"][item["bufferView"]]
        width = WIDTHS[item["type"]]
        assert view["byteOffset"] % 4 == 0
        assert view["byteLength"] == 4 * width * item["count"]
        found = np.frombuffer(binary, TYPES[item["componentType"]], item["count"] * width, view["byteOffset"])
        values.append(found.reshape(-1, width))
    return document, values
