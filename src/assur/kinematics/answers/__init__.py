"""What a problem answers: solutions by branch, reasons why there are none, curves of self-motion."""
