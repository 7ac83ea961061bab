"""The live view: the mechanism in a browser, solved by this library while it is moved."""
