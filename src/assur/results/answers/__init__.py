"""Answers: what each command says, as frozen data, at the border: angles and lengths in the file's units."""
