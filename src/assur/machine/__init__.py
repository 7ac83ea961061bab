"""From kinematics to a machine: masses, forces of the actuators, reactions in the joints."""
