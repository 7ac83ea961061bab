"""What actuators and joints bear: by virtual work, by Newton and Euler, and how much the actuators can."""
