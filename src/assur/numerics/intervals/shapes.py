"""Arrays of intervals put together and widened, bounds and definedness alike."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assur.numerics.intervals.interval import Interval


def stack(items: Sequence[Interval], axis: int = -1) -> Interval:
    """Intervals of one shape along a new axis.

    >>> stack([Interval.of([1.0, 2.0]), Interval.of([3.0, 4.0])]).low
    array([[1., 3.],
           [2., 4.]])
    """
    wide = [broadcast(interval, interval.shape) for interval in items]
    return Interval(
        np.stack([interval.low for interval in wide], axis=axis),
        np.stack([interval.high for interval in wide], axis=axis),
        np.stack([interval.defined for interval in wide], axis=axis),
    )


def concatenate(items: Sequence[Interval]) -> Interval:
    """Intervals one after the other along the first axis.

    >>> concatenate([Interval.of([1.0]), Interval.of([2.0, 3.0])]).high
    array([1., 2., 3.])
    """
    wide = [broadcast(interval, interval.shape) for interval in items]
    return Interval(
        np.concatenate([interval.low for interval in wide]),
        np.concatenate([interval.high for interval in wide]),
        np.concatenate([interval.defined for interval in wide]),
    )


def broadcast(interval: Interval, shape: tuple[int, ...]) -> Interval:
    """An interval as a view of another shape.

    >>> broadcast(Interval.of(1.0), (2,)).defined
    array([ True,  True])
    """
    if interval.low.shape == interval.high.shape == interval.defined.shape == shape:
        return interval
    low, high = np.broadcast_to(interval.low, shape), np.broadcast_to(interval.high, shape)
    return Interval(low, high, np.broadcast_to(interval.defined, shape))


def empty(width: int) -> Interval:
    """No rows of so many numbers: (0, width).

    >>> empty(3).shape
    (0, 3)
    """
    return Interval.of(np.zeros((0, width)))
