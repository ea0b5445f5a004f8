r"""Neural modes: a field is a mean and a few shapes, their amounts follow from two numbers.

A muscle that touches no other knows of the rest of the arm only the elbow's angle θ: its fields depend on (θ, a), a its
own activation. Hence

    field(X) = mean(X) + sum_k c_k(θ, a) φ_k(X)

    φ_k      proper orthogonal modes at the nodes                                     pod
    c_k      products of Chebyshev polynomials in θ and a                             chebyshev, surface
    θ        from all activations and the load by small networks                      angle_network, marquardt
    (θ, a)   from sensors by Gauss-Newton steps, from both by the same with priors    locating

    module      all of it in one torch module, with the deviation of what it answers
    learner     fits it: seconds of linear algebra, no gradient steps over nodes
    arm         all muscles with one network for the angle
    ridge       amounts of the modes straight from sensors, by ridge least squares
    volume      det F of positions, and whether the ends stay where they belong
"""
