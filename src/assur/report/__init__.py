"""The report: what all analyses found about a mechanism, as one self-contained HTML file."""

from assur.report.report import numbers_of, report_html, write_report

__all__ = ["numbers_of", "report_html", "write_report"]
