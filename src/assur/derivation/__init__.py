"""Analytic solutions derived from the joint graph alone, with the reasons of every step."""
