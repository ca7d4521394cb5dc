//! Files of points: CSV and airfoil coordinates.
