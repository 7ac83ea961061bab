"""How links, joints and actuators give way: structure, stiffness, vibrations."""
