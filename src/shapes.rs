//! Analytic surfaces and the paper's inputs as triangle meshes, regular and irregular.
