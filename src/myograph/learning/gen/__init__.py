"""Graph element networks: functions sampled at points go in, functions of any query point come out.

config              how a network is built; presets; the traps of the thesis's listings
mesh                the graph's nodes and edges
line                the same in one dimension
graph               the graph in torch
perceptron          layers with a nonlinearity between them
representer         how points share in nodes: softmax, or barycentric coordinates
barycentric         coordinates in the simplices of a triangulation
graph_convolution   the processor 'gcn'
processors          'mlp', 'mpnn', and the table of all
precision           single precision within mixed
geometric           PyTorch Geometric's convolutions
network             the whole in the unit box, in a space of any dimension
scaling             millimetres to the unit box and back
affine              the affine map that suits the sensors best
muscle              a network that takes mm and gives mm
trainable, learner  how it is trained on pairs
rebuild             how a saved one is built anew
"""
