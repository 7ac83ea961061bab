"""Which answers each command gives: the table from which `assur schema --answers` makes its schema."""

from __future__ import annotations

from assur.audit.rows import Audit
from assur.results.answers.catalogue import CatalogueAnswer, MechanismAnswer
from assur.results.answers.certified import CertifiedDirect, CertifiedInverse
from assur.results.answers.check import CheckAnswer
from assur.results.answers.comparison import CrossCheckAnswer
from assur.results.answers.files import (
    EndedView,
    WrittenExport,
    WrittenFigures,
    WrittenMechanism,
    WrittenMotion,
    WrittenPage,
    WrittenReport,
)
from assur.results.answers.installation import CacheAnswer, DemonstrationAnswer, InstallationAnswer
from assur.results.answers.position import DirectAnswer, InverseAnswer
from assur.results.answers.topology import SynthesisAnswer, TopologyAnswer

ANSWERS: dict[str, tuple[type, ...]] = {
    "audit": (Audit,),
    "cache": (CacheAnswer,),
    "check": (CheckAnswer,),
    "crosscheck": (CrossCheckAnswer,),
    "demo": (DemonstrationAnswer,),
    "direct": (DirectAnswer, CertifiedDirect),
    "doctor": (InstallationAnswer,),
    "export": (WrittenExport,),
    "figures": (WrittenFigures,),
    "inverse": (InverseAnswer, CertifiedInverse),
    "list": (CatalogueAnswer,),
    "motion": (WrittenMotion,),
    "new": (WrittenMechanism,),
    "page": (WrittenPage,),
    "report": (WrittenReport,),
    "show": (MechanismAnswer,),
    "synthesize": (SynthesisAnswer,),
    "topology": (TopologyAnswer,),
    "view": (EndedView,),
}
