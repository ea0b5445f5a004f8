"""What is known of each experiment before it runs: the thesis's question and figures, and the columns of our table.

Figures of the thesis are of its own, unpublished arm: they stand in sentences of their own, never in columns of ours.
"""

from dataclasses import dataclass

from myograph.errors import InputError
from myograph.evaluation.experiments.columns import COST, POSITION, SKIN, STRESS, WEIGHT, Column


@dataclass(frozen=True)
class About:
    """A section.

    Parameters
    ----------
    heading
        With its number in the thesis, if it has one.
    question
        What was asked.
    thesis
        What the thesis found, on its own data.
    columns
        Of our table.
    ours
        How ours differs, and how to read the table.
    """

    heading: str
    question: str
    thesis: str
    columns: tuple[Column, ...]
    ours: str


SECTIONS: dict[str, About] = {
    "6.2.1": About(
        "6.2.1 Learning target coordinates",
        "Where does every node of the biceps come to, told where nine of them came to? 32 activations {0, 1}^5, 25 "
        "of them initial states of the training.",
        "5.72 mm on 4,018 nodes after 990 epochs; on 2,809 nodes of the surface 7.0 mm, at most 25.6 mm; graphs of "
        "8 and of 343 nodes alike (5.8 mm). Feed-forward network from the activations: 2.8 mm, at most 10.79 mm.",
        (*POSITION, *SKIN, *COST),
        "'gen_thesis' is the thesis's network with its traps set right and modern rates; 'its rate' is trained at "
        "1e-4, constant, for 3,960 steps of 8 pairs (120 in the preset tiny): 990 epochs of four steps, a number that "
        "the thesis does not give; its graph nodes move at our rate, not at its 1e-1. 'improved' and "
        "'gen_8' are ours. Rows taught by more cases know the activations, and under 'thesis' have seen every target "
        "with them; the others know only what nine sensors say. The feed-forward network's steps are dear, and fewer. "
        "The kernel of 'pod_gp' was chosen on cases off the grid, which "
        "flatters its off_grid a little.",
    ),
    "6.2.2": About(
        "6.2.2 Learning the direction vector",
        "Does it help to learn how a node moves instead of where it comes to?",
        "5.5 mm, much as with coordinates.",
        (*POSITION, *COST),
        "'displacement' is T - S; 'direction_and_scale' its direction and its length apart.",
    ),
    "6.2.3": About(
        "6.2.3 Learning the maximum distortion criterion",
        "Von Mises stress at every node.",
        "2.2 MPa. A Gaussian process of Kneifl and others, from activations: 0.2 MPa in the mean, at most 11.5 MPa.",
        (*STRESS, *COST),
        "Stress by the right formula: the thesis's equation 6.1 has (σx - σz)² where (σy - σz)² belongs, and the "
        "last row says how far that formula is off on our data, without any network. 'pod_gp' and 'neural_modes' know "
        "the activations, and under 'thesis' have seen every target with them.",
    ),
    "6.2.4": About(
        "6.2.4 Reducing complexity",
        "How small may encoder, decoder and latent space become?",
        "Width 16 is as good as 32; width 8 is worse, a latent space of 1 as well: 'a minimum of a latent space "
        "with dimension 8 and a layer dimension of 16'.",
        (*POSITION, *COST),
        "Names are the hidden layers and the latent space. The thesis's text does not give the legend of its figure"
        " 6.4 in full; five follow its words, '16, latent 8' is the least that its conclusion allows. LayerNorm over "
        "one number is a constant: a network with latent 1 cannot see what the sensors say.",
    ),
    "meshes": About(
        "Mesh size",
        "Is there 'no need for a huge mesh'?",
        "Graphs of 8 and of 343 nodes were alike.",
        (*POSITION, *COST),
        "Listing 5.2 takes the softmax of plus distance, so that the farthest node wins and most nodes of a large "
        "graph never count: 'legacy_sign'. All graphs are trained for as many steps.",
    ),
    "sensors": About(
        "Number of sensors",
        "How many known nodes are needed?",
        "Nine, at random.",
        (*POSITION, *COST),
        "The same methods with more and fewer sensors, placed at random, once. A spline needs four.",
    ),
    "steps": About(
        "Activation step",
        "Do training activations have to lie at the corners?",
        "32 random activations at different steps are named; figures are given for step 1.0.",
        (*POSITION, *COST),
        "32 cases at each step. off_grid tests all on the same continuous activations; thesis and strict test on "
        "cases of the step's own, which are the harder the farther apart they lie. One draw of the cases and one seed: "
        "what is nearly alike is not told apart.",
    ),
    "direct": About(
        "Direct finite elements (future work)",
        "Does a table of finite-element states in place of direct solves cost accuracy?",
        "'The data for this experiment were not yet available.'",
        (*POSITION, *COST),
        "Taught on either; the truth is always a direct solve at the equilibrium of the whole arm. One seed: what is "
        "nearly alike is not told apart.",
    ),
    "convolutions": About(
        "Other convolutions (future work)",
        "Do other convolutions make message passing more effective?",
        "Named as future work.",
        (*POSITION, *COST, Column("answer, ms", "predict_ms")),
        "27 nodes, all else alike, one seed: what is nearly alike is not told apart. Names with capitals are layers "
        "of PyTorch Geometric; the time of an answer is that of the fastest of some.",
    ),
    "edge": About(
        "A thin model for a prosthesis (future work)",
        "What is the smallest model within 0.5 mm, and how many simulations does it need?",
        "Named as future work.",
        (*POSITION, *COST[:4], *WEIGHT),
        "The smallest is that of those tried here, from one seed, chosen by the mean errors of this very table under "
        "strict and off_grid; neural modes have seen the targets of 'thesis' with their activations. One answer is all "
        "nodes of the biceps; its time is that of onnxruntime, the fastest of many, and of plain C, on one core of the "
        "machine that ran this. In C neural modes stand as floats, or as int8 within 0.05 mm of them. Rows with "
        "'cases' are the learning curve: so many cases out of a pool of random tenths, taken at random, or each where "
        "the Gaussian process taught so far has the 'largest deviation', or where it leaves the 'least deviation' over "
        "the pool; tested on continuous activations.",
    ),
}


def about(name: str) -> About:
    """The section; raises InputError for a name that is none."""
    if name not in SECTIONS:
        raise InputError(f"section '{name}': expected one of {', '.join(SECTIONS)}")
    return SECTIONS[name]
