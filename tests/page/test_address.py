"""The address of a page says how its joints stand as the page itself does."""

import base64

import numpy as np

from assur.page.address import joints_hash


def test_joint_values_are_32_bit_numbers_in_letters_that_an_address_may_hold():
    values = np.random.default_rng(0).normal(size=15)
    name, _, text = joints_hash(values).partition("=")
    assert name == "#joints"
    assert not set("+/=") & set(text)
    back = np.frombuffer(base64.urlsafe_b64decode(text + "=" * (-len(text) % 4)), dtype="<f4")
    np.testing.assert_allclose(back, values, rtol=1e-7)
