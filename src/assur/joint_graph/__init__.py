"""The joint graph: links and joints as the file gives them, where its loops do not close, and how it moves."""
