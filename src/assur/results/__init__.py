"""The few kinds of result that analyses give and that reports, figures and the command line render."""
