"""Which answers each command gives: the table from which `assur schema --answers` makes its schema."""

from __future__ import annotations

from assur.audit.rows import Audit
from assur.results.answers.calibration import CalibrationAnswer
from assur.results.answers.catalogue import CatalogueAnswer, MechanismAnswer, SchemaAnswer
from assur.results.answers.certificate import (
    NoCertificate,
    RefusedCertificate,
    VerifiedCertificate,
    WrittenCertificate,
)
from assur.results.answers.certified import CertifiedDirect, CertifiedInverse
from assur.results.answers.check import CheckAnswer
from assur.results.answers.comparison import CrossCheckAnswer
from assur.results.answers.derivation import DerivationAnswer, VerifiedDerivation
from assur.results.answers.dynamics import DynamicsAnswer, LinearMotionAnswer
from assur.results.answers.errors import ErrorsAnswer
from assur.results.answers.files import (
    EndedView,
    WrittenExport,
    WrittenFigures,
    WrittenMechanism,
    WrittenMotion,
    WrittenPage,
    WrittenReport,
)
from assur.results.answers.forces import CapacityAnswer, ForcesAnswer, MotionFormulasAnswer
from assur.results.answers.identification import IdentificationAnswer
from assur.results.answers.indices import IndicesAnswer, MapsAnswer, OverallAnswer
from assur.results.answers.installation import CacheAnswer, DemonstrationAnswer, InstallationAnswer
from assur.results.answers.masses import MassesAnswer
from assur.results.answers.path import NoPath, PathAnswer
from assur.results.answers.position import DirectAnswer, InverseAnswer
from assur.results.answers.region import (
    AspectsAnswer,
    AspectsOfModes,
    CertifiedBox,
    CertifiedShape,
    CertifiedVolume,
    CollisionsAnswer,
    WorkspaceAnswer,
)
from assur.results.answers.singularity import ConfigurationAnswer, SingularityAnswer
from assur.results.answers.stiffness import StiffnessAnswer
from assur.results.answers.sweep import SweepAnswer
from assur.results.answers.synthesis import ExplanationAnswer, SynthesisAnswer
from assur.results.answers.topology import TopologyAnswer

ANSWERS: dict[str, tuple[type, ...]] = {
    "aspects": (AspectsAnswer, AspectsOfModes),
    "audit": (Audit,),
    "cache": (CacheAnswer,),
    "calibrate": (CalibrationAnswer,),
    "certify": (WrittenCertificate, NoCertificate),
    "check": (CheckAnswer,),
    "collisions": (CollisionsAnswer,),
    "crosscheck": (CrossCheckAnswer,),
    "demo": (DemonstrationAnswer,),
    "derive": (DerivationAnswer,),
    "direct": (DirectAnswer, CertifiedDirect),
    "doctor": (InstallationAnswer,),
    "dynamics": (DynamicsAnswer, LinearMotionAnswer),
    "errors": (ErrorsAnswer, MapsAnswer),
    "export": (WrittenExport,),
    "figures": (WrittenFigures,),
    "follow": (PathAnswer, NoPath, DirectAnswer, InverseAnswer),
    "forces": (ForcesAnswer, CapacityAnswer, MapsAnswer, MotionFormulasAnswer),
    "identify": (IdentificationAnswer,),
    "indices": (IndicesAnswer, OverallAnswer, MapsAnswer),
    "inverse": (InverseAnswer, CertifiedInverse),
    "list": (CatalogueAnswer,),
    "motion": (WrittenMotion,),
    "new": (WrittenMechanism,),
    "page": (WrittenPage,),
    "report": (WrittenReport,),
    "schema": (SchemaAnswer,),
    "show": (MechanismAnswer, MassesAnswer),
    "singularity": (ConfigurationAnswer, SingularityAnswer),
    "stiffness": (StiffnessAnswer, MapsAnswer),
    "sweep": (SweepAnswer,),
    "synthesize": (SynthesisAnswer, ExplanationAnswer),
    "topology": (TopologyAnswer,),
    "verify": (VerifiedCertificate, VerifiedDerivation, RefusedCertificate),
    "view": (EndedView,),
    "workspace": (WorkspaceAnswer, CertifiedVolume, CertifiedBox, CertifiedShape),
}
