"""What to ask of images and algorithms: errors, convergence, correctness."""
