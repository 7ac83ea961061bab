"""The report: what all analyses found about a mechanism, as one self-contained HTML file."""

from assur.report.report import report_html, write_report

__all__ = ["report_html", "write_report"]
