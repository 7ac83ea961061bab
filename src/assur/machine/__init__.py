"""From kinematics to a machine: masses, motion, forces, dynamics, elasticity, accuracy, calibration, in this order."""
