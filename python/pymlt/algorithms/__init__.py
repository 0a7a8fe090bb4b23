"""Light transport algorithms: what plug-ins there are, and classes made from their schemas."""
