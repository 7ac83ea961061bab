"""Closed forms that are wrong where no check looks: what they give must not be called a solution."""

import dataclasses


def with_wrong_joints(record, joint, amount):
    """The mechanism with formulas that give one joint value wrong by an amount."""
    form = record.closed_form

    def joints(ns, p, core):
        found = dict(form.joints(ns, p, core))
        return {**found, joint: found[joint] + amount}

    return dataclasses.replace(record, closed_form=dataclasses.replace(form, joints=joints))
