"""The report: what all analyses found about a mechanism, as one self-contained HTML file."""
