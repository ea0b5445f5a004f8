"""The affine map that suits the sensors best."""

import numpy as np
import torch

from myograph.learning.gen.affine import affine_map, inverse


def test_the_inverse_of_a_matrix_times_the_matrix_is_one():
    matrix = torch.randn(4, 3, 3, dtype=torch.float64, generator=torch.Generator().manual_seed(0))
    torch.testing.assert_close(inverse(matrix) @ matrix, torch.eye(3, dtype=torch.float64).expand(4, 3, 3))


def test_an_affine_function_of_a_body_is_reproduced_to_the_ridge():
    draw = np.random.default_rng(0)
    points, queries = (torch.tensor(draw.uniform(size=(2, n, 3)) * [60, 40, 300]) for n in (9, 20))
    matrix, offset = torch.tensor(0.1 * draw.normal(size=(3, 3))), torch.tensor(draw.normal(size=3))
    answer = affine_map(points, points @ matrix + offset, queries)
    right = queries @ matrix + offset
    assert (answer - right).abs().max() < 0.02 * right.std()


def test_it_is_the_affine_least_squares_of_numpy():
    draw = np.random.default_rng(0)
    points, values, queries = draw.uniform(size=(9, 3)) * 50, draw.normal(size=(9, 3)), draw.uniform(size=(20, 3)) * 50
    ones = np.concatenate([points, np.ones((9, 1))], axis=1)
    expected = np.concatenate([queries, np.ones((20, 1))], axis=1) @ np.linalg.lstsq(ones, values)[0]
    answer = affine_map(*(torch.tensor(array)[None] for array in (points, values, queries)))
    np.testing.assert_allclose(answer[0], expected, atol=0.01)


def test_one_sensor_or_sensors_in_one_plane_do_no_harm():
    points, values = torch.rand(1, 9, 3), torch.rand(1, 9, 3)
    flat = points * torch.tensor([1.0, 1.0, 0.0])
    queries = torch.rand(1, 20, 3)
    torch.testing.assert_close(affine_map(points[:, :1], values[:, :1], queries), values[:, :1].expand(-1, 20, -1))
    assert affine_map(flat, values, queries * torch.tensor([1.0, 1.0, 0.0])).abs().max() < 10
