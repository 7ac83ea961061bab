"""The version, of which nothing else is needed."""

VERSION = "0.1.0"
